#pragma once
#include "app/render/image.hpp"
#include "app/render/picture.hpp"

#include <string>

namespace clay::render {

/// A swatch of the wall map, as an sRGB colour, that a thickness [mm] has.
struct Swatch {
  std::uint8_t red = 0, green = 0, blue = 0;
};
[[nodiscard]] Swatch wall_swatch(const WallMap& map, double wall_mm) noexcept;

/// The scale of the wall map on the left of a picture: labelled in mm, the limit marked. Left out
/// of pictures that have no room for it.
void draw_legend(const WallMap& map, Theme theme, Image& image);

}  // namespace clay::render
