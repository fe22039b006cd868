#include "core/svg_writer.hpp"

#include <array>
#include <charconv>
#include <cstddef>
#include <cstdint>

namespace clay {
namespace {

constexpr std::string_view kReplacement = "\xEF\xBF\xBD";

std::size_t length_by_lead(unsigned char lead) {
  if (lead < 0x80) return 1;
  if (lead >= 0xC2 && lead < 0xE0) return 2;
  if (lead >= 0xE0 && lead < 0xF0) return 3;
  if (lead >= 0xF0 && lead < 0xF5) return 4;
  return 0;
}

/// Length of the first character if XML 1.0 permits it (production 2); otherwise 0.
std::size_t allowed(std::string_view text) {
  const auto byte = [&](std::size_t i) { return static_cast<unsigned char>(text[i]); };
  const std::size_t length = length_by_lead(byte(0));
  if (length == 0 || length > text.size()) return 0;
  if (length == 1) {
    const bool blank = text[0] == '\t' || text[0] == '\n' || text[0] == '\r';
    return byte(0) >= 0x20 || blank ? 1 : 0;
  }
  std::uint32_t code = byte(0) & (0xFFu >> (length + 1));
  for (std::size_t i = 1; i < length; ++i) {
    if ((byte(i) & 0xC0) != 0x80) return 0;
    code = code << 6 | (byte(i) & 0x3Fu);
  }
  constexpr std::array<std::uint32_t, 5> kLeast{0, 0, 0x80, 0x800, 0x10000};
  const bool surrogate = code >= 0xD800 && code < 0xE000;
  const bool none = code == 0xFFFE || code == 0xFFFF || code > 0x10FFFF;
  return code < kLeast[length] || surrogate || none ? 0 : length;
}

std::string_view entity(char character) {
  switch (character) {
    case '&':
      return "&amp;";
    case '<':
      return "&lt;";
    case '>':
      return "&gt;";
    case '"':
      return "&quot;";
    case '\'':
      return "&#39;";
    default:
      return {};
  }
}

}  // namespace

std::string escaped(std::string_view text) {
  std::string safe;
  while (!text.empty()) {
    const std::size_t length = allowed(text);
    if (length == 0)
      safe += kReplacement;
    else if (const auto name = entity(text[0]); !name.empty())
      safe += name;
    else
      safe += text.substr(0, length);
    text.remove_prefix(length == 0 ? 1 : length);
  }
  return safe;
}

std::string fixed(double number, int digits) {
  std::array<char, 400> text{};  // enough for the largest double
  const auto end = std::to_chars(text.data(), text.data() + text.size(), number,
                                 std::chars_format::fixed, digits);
  return {text.data(), end.ptr};
}

void SvgWriter::element(std::string_view name, Attributes attributes, std::string_view text) {
  begin(name, attributes);
  if (text.empty())
    svg_ += "/>\n";
  else
    svg_.append(">").append(escaped(text)).append("</").append(name).append(">\n");
}

void SvgWriter::open(std::string_view name, Attributes attributes) {
  begin(name, attributes);
  svg_ += ">\n";
}

void SvgWriter::close(std::string_view name) { svg_.append("</").append(name).append(">\n"); }

void SvgWriter::begin(std::string_view name, Attributes attributes) {
  svg_.append("<").append(name);
  for (const auto& [key, value] : attributes)
    if (!value.empty())
      svg_.append(" ").append(key).append("=\"").append(escaped(value)).append("\"");
}

}  // namespace clay
