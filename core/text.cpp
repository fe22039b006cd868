#include "core/text.hpp"

#include <algorithm>
#include <array>
#include <charconv>

namespace clay {
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

template <class... Format>
std::string digits_of(double value, Format... format) {
  std::array<char, 32> text{};  // the longest number has 24
  return {text.data(), std::to_chars(text.data(), text.data() + text.size(), value, format...).ptr};
}

}  // namespace

std::string number_text(double value) { return digits_of(value); }
std::string short_number_text(double value) {
  return digits_of(value, std::chars_format::general, 6);
}
std::string in_mm(double mm) { return digits_of(mm, std::chars_format::general, 9); }

std::string_view without_byte_order_mark(std::string_view text) noexcept {
  if (text.starts_with("\xEF\xBB\xBF")) text.remove_prefix(3);
  return text;
}

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
  if (!std::all_of(first.begin(), first.end(), is_text)) return "binary data";
  return "text that begins with '" +
         std::string(first.substr(0, std::min(first.find_first_of("\r\n"), first.size()))) + "'";
}

}  // namespace clay
