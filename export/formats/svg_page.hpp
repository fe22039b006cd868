#pragma once
// A page of SVG: elements in px, y down, in the colours of section drawings.

#include "core/svg_writer.hpp"

#include <glm/vec2.hpp>
#include <string>
#include <string_view>
#include <vector>

namespace clay::solid::inline formats {

class SvgPage {
 public:
  /// With its own background, for light and dark themes.
  SvgPage(glm::dvec2 size, std::string_view title);

  /// Fills closed outlines. Styles are listed in svg_page.cpp.
  void fill(std::string_view style, const std::vector<std::vector<glm::dvec2>>& outlines);
  void rectangle(std::string_view style, glm::dvec2 corner, glm::dvec2 size);
  void line(std::string_view style, glm::dvec2 from, glm::dvec2 to);
  /// A line with an arrow at each end.
  void dimension(glm::dvec2 from, glm::dvec2 to);

  enum class Anchor { start, middle, end };
  void text(glm::dvec2 where, std::string_view words, Anchor anchor);
  /// Text that reads upward, centred at `where`.
  void upright_text(glm::dvec2 where, std::string_view words);

  /// The whole document; do not use the page afterwards.
  [[nodiscard]] std::string finish();

 private:
  SvgWriter svg_;
};

}  // namespace clay::solid::inline formats
