#pragma once
// A small picture of a pot without OpenGL, for files: it takes a few ms and is the same on every
// machine.

#include "app/render/image.hpp"
#include "app/render/picture.hpp"

namespace clay::render {

/// The geometry alone, on a plain ground, from the usual viewpoint; width and height are `side_px`.
[[nodiscard]] Image thumbnail(const PotView& pot, int side_px);

}  // namespace clay::render
