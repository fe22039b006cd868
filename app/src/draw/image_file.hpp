#pragma once
// Pictures as bytes of files; publish them with the engine's atomic publisher.

#include "claystack/engine/result.hpp"
#include "draw/image.hpp"

#include <string>
#include <vector>

namespace clay::draw {

/// RGBA, 8 bits. Needs an image of at least one pixel.
std::string png_of(const Image& image);

/// Plays for ever. Alpha is left out; all frames share one palette of 256 colours. Needs at least
/// one frame, all of one size. `delay_ms` between frames, to the nearest 10.
Result<std::string> gif_of(const std::vector<Image>& frames, int delay_ms);

}  // namespace clay::draw
