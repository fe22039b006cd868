#include "core/text.hpp"

#include "core/little_endian.hpp"
#include "core/lower_case.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <cstddef>
#include <cstdint>
#include <utility>

namespace clay {
namespace {

struct Beginning {
  std::string_view bytes, kind;
};
constexpr Beginning kBeginnings[] = {
    {"DRACO", "a Draco mesh"},        {"PK\x03\x04", "a zip archive, as 3MF is"},
    {"glTF", "a GLB model"},          {"ply\n", "a PLY mesh"},
    {"ply\r", "a PLY mesh"},          {"<svg", "an SVG drawing"},
    {"<?xml", "an XML document"},     {"solid ", "an STL mesh in text"},
    {"OFF", "an OFF mesh"},           {"%PDF", "a PDF document"},
    {"ISO-10303-21", "a STEP model"}, {"\x89PNG", "a PNG picture"},
    {"GIF8", "a GIF picture"},        {"AC10", "a DWG drawing"},
    {"%!PS", "a PostScript drawing"}, {"\x1F\x8B", "a gzip archive"}};
// The project's own files, JSON or CBOR, have the name of their schema in their first bytes.
constexpr Beginning kSchemas[] = {{"claystack-pot-", "a pot"},
                                  {"claystack-scene-", "a scene"},
                                  {"claystack-session-", "a session"},
                                  {"claystack-work-", "a work"},
                                  {"claystack-certificate-", "a certificate"},
                                  {"claystack-process-", "a process"},
                                  {"claystack-studio-", "a settings file"}};
constexpr std::size_t kSchemaBytes = 4096;

constexpr std::string_view kReplacement = "\xEF\xBF\xBD";

std::size_t length_by_lead(unsigned char lead) {
  if (lead < 0x80) return 1;
  if (lead >= 0xC2 && lead < 0xE0) return 2;
  if (lead >= 0xE0 && lead < 0xF0) return 3;
  if (lead >= 0xF0 && lead < 0xF5) return 4;
  return 0;
}

struct Character {
  std::uint32_t code = 0;
  std::size_t length = 0;  ///< in bytes; 0: not UTF-8, or XML 1.0 forbids it (production 2)
};

/// The first character of a text that is not empty.
Character first_of(std::string_view text) {
  const auto byte = [&](std::size_t i) { return static_cast<unsigned char>(text[i]); };
  const std::size_t length = length_by_lead(byte(0));
  if (length == 0 || length > text.size()) return {};
  if (length == 1) {
    const bool blank = text[0] == '\t' || text[0] == '\n' || text[0] == '\r';
    return {byte(0), byte(0) >= 0x20 || blank ? 1u : 0u};
  }
  std::uint32_t code = byte(0) & (0xFFu >> (length + 1));
  for (std::size_t i = 1; i < length; ++i) {
    if ((byte(i) & 0xC0) != 0x80) return {};
    code = code << 6 | (byte(i) & 0x3Fu);
  }
  constexpr std::array<std::uint32_t, 5> kLeast{0, 0, 0x80, 0x800, 0x10000};
  const bool surrogate = code >= 0xD800 && code < 0xE000;
  const bool none = code == 0xFFFE || code == 0xFFFF || code > 0x10FFFF;
  return {code, code < kLeast[length] || surrogate || none ? 0 : length};
}

/// No control character, and none that hides or reorders the text around it.
bool is_visible(std::uint32_t code) {
  constexpr std::pair<std::uint32_t, std::uint32_t> kHidden[] = {
      {0x0, 0x1F},      {0x7F, 0x9F},     {0xAD, 0xAD},     {0x200B, 0x200F},
      {0x2028, 0x202E}, {0x2060, 0x206F}, {0xFEFF, 0xFEFF}, {0xE0000, 0xE0FFF}};
  return std::ranges::none_of(
      kHidden, [&](const auto& range) { return code >= range.first && code <= range.second; });
}

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
std::string nine_digit_text(double value) {
  return digits_of(value, std::chars_format::general, 9);
}

std::string expected_number(std::string_view of_what, std::size_t first, std::size_t count) {
  const std::string expected = "expected the number of " + std::string(of_what);
  if (count == 0) return expected + ", but there is none";
  return expected + ", from " + std::to_string(first) + " to " + std::to_string(first + count - 1);
}

std::string sentence(std::string text) {
  if (!text.empty() && text[0] >= 'a' && text[0] <= 'z')
    text[0] = static_cast<char>(text[0] - 'a' + 'A');
  return text;
}

std::string words_of_name(std::string_view name) {
  std::string words(name);
  std::ranges::replace(words, '_', ' ');
  return words;
}

std::string counted(std::size_t count, std::string_view noun) {
  return std::to_string(count).append(" ").append(noun).append(count == 1 ? "" : "s");
}

bool ends_ignoring_case(std::string_view text, std::string_view ending) noexcept {
  return text.size() >= ending.size() &&
         std::ranges::equal(text.substr(text.size() - ending.size()), ending, {},
                            [](char c) { return lower_case(c); });
}

std::string name_of_file(std::string_view path) {
  std::string_view name = path.substr(path.rfind('/') + 1);
  if (name == "-") return "pot";
  constexpr std::string_view kKinds[] = {".pot.json", ".pot.cbor", ".scene.json", ".process.json"};
  for (const std::string_view kind : kKinds)
    if (name.size() > kind.size() && ends_ignoring_case(name, kind))
      return std::string(name.substr(0, name.size() - kind.size()));
  const std::size_t dot = name.rfind('.');
  return std::string(dot == 0 ? name : name.substr(0, dot));
}

std::string_view without_byte_order_mark(std::string_view text) noexcept {
  if (text.starts_with("\xEF\xBB\xBF")) text.remove_prefix(3);
  return text;
}

bool is_binary_stl(std::string_view head, std::uint64_t file_bytes) {
  constexpr std::size_t kHeaderBytes = 80, kFacetBytes = 50;
  if (head.size() < kHeaderBytes + sizeof(std::uint32_t)) return false;
  const std::uint64_t facets = load_u32(head.data() + kHeaderBytes);
  return facets > 0 && file_bytes == kHeaderBytes + sizeof(std::uint32_t) + kFacetBytes * facets;
}

std::string_view known_kind(std::string_view bytes) {
  for (const auto& [beginning, kind] : kBeginnings)
    if (bytes.starts_with(beginning)) return kind;
  if (is_binary_stl(bytes, bytes.size())) return "an STL mesh";
  const std::string_view first = bytes.substr(0, kSchemaBytes);
  if (const std::size_t at = first.find("claystack-"); at != std::string_view::npos)
    for (const auto& [schema, kind] : kSchemas)
      if (first.substr(at).starts_with(schema)) return kind;
  if (bytes.starts_with("{") && first.find("\"strokes\"") != std::string_view::npos)
    return "a stroke script";
  return bytes.starts_with("{") ? "a JSON file" : std::string_view();
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

Error kind_error(Error error, std::string_view bytes, std::string_view name,
                 std::string_view expected) {
  const std::string_view kind = known_kind(bytes);
  const bool same = kind.empty() || kind == "a JSON file" || expected.starts_with(kind);
  if (same || error.kind != ErrorKind::bad_input) return error;
  return {ErrorKind::bad_input,
          std::string(name).append(": expected ").append(expected).append(", found ").append(kind)};
}

std::string shown(std::string_view text, std::size_t most) {
  std::string result;
  for (std::size_t count = 0; count < most && !text.empty(); ++count) {
    const auto [code, length] = first_of(text);
    result += length > 0 && is_visible(code) ? text.substr(0, length) : "?";
    text.remove_prefix(std::max<std::size_t>(length, 1));
  }
  return text.empty() ? result : result + "...";
}

std::string valid_text(std::string_view text) {
  std::string valid;
  while (!text.empty()) {
    const std::size_t length = first_of(text).length;
    valid += length == 0 ? kReplacement : text.substr(0, length);
    text.remove_prefix(length == 0 ? 1 : length);
  }
  return valid;
}

}  // namespace clay
