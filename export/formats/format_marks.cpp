#include "export/formats/format_marks.hpp"

#include "claystack/export/formats.hpp"
#include "core/text.hpp"
#include "export/formats/stl_layout.hpp"
#include "export/formats/text_scanner.hpp"

#include <algorithm>
#include <utility>

namespace clay::solid::inline formats {
namespace {

constexpr std::string_view kBlanks = " \t\r\n";

std::string_view without_blanks(std::string_view bytes) {
  return bytes.substr(std::min(bytes.find_first_not_of(kBlanks), bytes.size()));
}

/// The first word that is not in a comment.
std::string_view first_word(std::string_view bytes) {
  bytes = without_blanks(without_byte_order_mark(bytes));
  while (bytes.starts_with('#'))
    bytes = without_blanks(bytes.substr(std::min(bytes.find('\n'), bytes.size())));
  return bytes.substr(0, bytes.find_first_of(" \t\r\n#"));
}

}  // namespace

bool begins_with_solid(std::string_view bytes) {
  return equal_ignoring_case(without_blanks(without_byte_order_mark(bytes)).substr(0, 5), "solid");
}

bool is_text(std::string_view head) {
  return head.substr(0, stl::kPrologueBytes).find('\0') == std::string_view::npos;
}

bool is_off_keyword(std::string_view word) {
  for (const std::string_view part : {"ST", "C", "N"})
    if (word.starts_with(part)) word.remove_prefix(part.size());
  return word == "OFF";
}

bool is_off_count(std::string_view word) {
  return !word.empty() && word.find_first_not_of("0123456789") == std::string_view::npos;
}

MeshFormat mesh_format_of_bytes(std::string_view bytes) {
  constexpr std::pair<std::string_view, MeshFormat> kBegins[] = {{"PK", MeshFormat::three_mf},
                                                                 {"glTF", MeshFormat::glb},
                                                                 {"DRACO", MeshFormat::drc},
                                                                 {"ply", MeshFormat::ply}};
  if (is_binary_stl(bytes, bytes.size())) return MeshFormat::stl_binary;
  for (const auto& [begin, format] : kBegins)
    if (bytes.starts_with(begin)) return format;
  if (begins_with_solid(bytes) || !is_text(bytes)) return MeshFormat::stl_binary;
  const std::string_view word = first_word(bytes);
  return is_off_keyword(word) || is_off_count(word) ? MeshFormat::off : MeshFormat::obj;
}

}  // namespace clay::solid::inline formats
