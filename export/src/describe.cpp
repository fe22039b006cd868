#include "describe.hpp"

#include <algorithm>

namespace clay::solid {
namespace {

struct Beginning {
  std::string_view bytes, kind;
};
constexpr Beginning kBeginnings[] = {{"DRACO", "a Draco mesh"},
                                     {"PK\x03\x04", "a zip archive, as 3MF is"},
                                     {"glTF", "a binary glTF model"},
                                     {"ply\n", "a PLY mesh"},
                                     {"ply\r", "a PLY mesh"},
                                     {"<svg", "an SVG drawing"},
                                     {"<?xml", "an XML document"},
                                     {"solid ", "an STL mesh in text"},
                                     {"%PDF", "a PDF document"},
                                     {"ISO-10303-21", "a STEP model"},
                                     {"{", "a JSON file"},
                                     {"\x89PNG", "a PNG picture"}};

bool is_text(char c) { return (c >= ' ' && c <= '~') || c == '\t' || c == '\r' || c == '\n'; }

}  // namespace

std::string_view known_kind(std::string_view bytes) {
  for (const auto& [beginning, kind] : kBeginnings)
    if (bytes.starts_with(beginning)) return kind;
  return {};
}

std::string kind_of_file(std::string_view bytes) {
  if (bytes.empty()) return "an empty file";
  if (const auto kind = known_kind(bytes); !kind.empty()) return std::string(kind);
  constexpr std::size_t kEnough = 20;
  const std::string_view first = bytes.substr(0, kEnough);
  if (!std::all_of(first.begin(), first.end(), is_text)) return "data that is no text";
  return "text that begins with '" +
         std::string(first.substr(0, std::min(first.find_first_of("\r\n"), first.size()))) + "'";
}

}  // namespace clay::solid
