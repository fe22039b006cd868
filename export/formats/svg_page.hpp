#pragma once
// A page of SVG: elements in px, y down, in the colours of section drawings.

#include <glm/vec2.hpp>
#include <initializer_list>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace clay::solid::inline formats {

/// `number` with that many decimals, independent of the locale.
[[nodiscard]] std::string fixed(double number, int digits);

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
  using Attributes = std::initializer_list<std::pair<std::string_view, std::string_view>>;
  void element(std::string_view name, Attributes attributes, std::string_view content = {});

  std::string svg_;
};

}  // namespace clay::solid::inline formats
