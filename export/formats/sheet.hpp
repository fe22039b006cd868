#pragma once
// A technical drawing at 1:1, as lines and texts on named layers, and its files.

#include "claystack/core/result.hpp"

#include <array>
#include <cstddef>
#include <glm/vec2.hpp>
#include <string>
#include <string_view>
#include <vector>

namespace clay::solid::inline formats {

enum class SheetLayer { outside, section, axis, dimensions, rib, text, scale };

/// Style of a layer.
struct LayerStyle {
  std::string_view name;    ///< in SVG and DXF
  double red, green, blue;  ///< 0 to 1
  double width_mm;
  bool filled;     ///< outlines are filled lightly
  bool dash_dot;   ///< as the axis
  int dxf_colour;  ///< of AutoCAD's index
};
inline constexpr std::array kLayerStyles{
    LayerStyle{"outside", 0.60, 0.50, 0.42, 0.18, false, false, 8},
    LayerStyle{"section", 0.35, 0.20, 0.10, 0.35, true, false, 7},
    LayerStyle{"axis", 0.25, 0.25, 0.25, 0.18, false, true, 1},
    LayerStyle{"dimensions", 0.10, 0.25, 0.50, 0.18, false, false, 5},
    LayerStyle{"rib", 0.10, 0.40, 0.20, 0.25, false, false, 3},
    LayerStyle{"text", 0.10, 0.10, 0.10, 0.18, false, false, 7},
    LayerStyle{"scale", 0.10, 0.10, 0.10, 0.35, false, false, 7}};

[[nodiscard]] constexpr const LayerStyle& style_of(SheetLayer layer) noexcept {
  return kLayerStyles[static_cast<std::size_t>(layer)];
}

/// Outlines, filled by the even-odd rule, or open lines.
struct SheetLines {
  SheetLayer layer = SheetLayer::section;
  std::vector<std::vector<glm::dvec2>> lines;
  bool closed = false;
};

struct SheetText {
  enum class Anchor { start, middle, end };
  SheetLayer layer = SheetLayer::text;
  glm::dvec2 at{0.0};  ///< of the base line
  std::string words;
  double height_mm = 3.0;  ///< of capitals, about
  Anchor anchor = Anchor::start;
  bool upright = false;  ///< reads upward
};

/// In mm, y up. The axis of the pot is x = 0, and the wheel head y = 0.
struct Sheet {
  std::string title;
  glm::dvec2 low{0.0}, high{0.0};  ///< the corners of the paper
  std::vector<SheetLines> lines;
  std::vector<SheetText> texts;
};

/// A page in mm with a group for each layer.
[[nodiscard]] std::string svg_of(const Sheet& sheet);
/// DXF R12 in mm: LINE, POLYLINE and TEXT, a layer for each layer. Without the paper.
[[nodiscard]] std::string dxf_of(const Sheet& sheet);
/// One page at 1:1. Equal sheets give equal bytes where the fonts are equal. Error (io): cairo
/// could not write it.
[[nodiscard]] Result<std::string> pdf_of(const Sheet& sheet);

}  // namespace clay::solid::inline formats
