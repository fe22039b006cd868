#pragma once
// A small picture of a pot without OpenGL, for files: it takes a few ms and is the same on every
// machine.

#include "app/render/image.hpp"
#include "app/render/picture.hpp"

namespace clay::render {

/// The geometry alone, on a plain ground, in a square of so many pixels; from the usual viewpoint.
[[nodiscard]] Image thumbnail(const PotView& pot, int pixels);

}  // namespace clay::render
