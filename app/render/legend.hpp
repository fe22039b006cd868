#pragma once
#include "app/render/image.hpp"
#include "app/render/picture.hpp"

#include <string>

namespace clay::render {

/// A swatch of the wall map: an sRGB colour.
struct Swatch {
  std::uint8_t red = 0, green = 0, blue = 0;
};
[[nodiscard]] Swatch wall_swatch(const WallMap& map, double wall_mm) noexcept;

/// The scale of the wall map on the left of a picture: labelled in mm, with the limit marked.
/// Omitted in pictures that are too small.
void draw_legend(const WallMap& map, Theme theme, Image& image);

}  // namespace clay::render
