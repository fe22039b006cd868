#include "export/formats/three_mf_text.hpp"

#include "export/formats/file_floats.hpp"

namespace clay::solid::inline formats::three_mf {

std::string xml_escaped(std::string_view text) {
  std::string xml;
  for (const char c : one_line(text)) switch (c) {
      case '&':
        xml += "&amp;";
        break;
      case '<':
        xml += "&lt;";
        break;
      case '>':
        xml += "&gt;";
        break;
      case '"':
        xml += "&quot;";
        break;
      default:
        xml += c;
    }
  return xml;
}

std::string body_name(const std::string& name, std::size_t number, std::size_t bodies) {
  return bodies == 1 ? name : name + " part " + std::to_string(number);
}

}  // namespace clay::solid::inline formats::three_mf
