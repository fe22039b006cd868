#include "core/svg_writer.hpp"

#include "core/text.hpp"

namespace clay {
namespace {

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
  for (const char character : valid_text(text))
    if (const auto name = entity(character); !name.empty())
      safe += name;
    else
      safe += character;
  return safe;
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
