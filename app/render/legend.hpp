#pragma once
#include "app/render/image.hpp"
#include "app/render/picture.hpp"
#include "app/render/wall_swatch.hpp"

namespace clay::render {

/// Draws the scale of the wall map on a panel at the left of a picture: labelled in mm, with the
/// hatching of walls below the limit. Omitted in pictures that are too small. For files: builds
/// with cairo only; the window draws its own.
void draw_legend(const WallMap& map, Theme theme, Image& image);

}  // namespace clay::render
