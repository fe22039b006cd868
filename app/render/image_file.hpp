#pragma once
// Encodes pictures as bytes of files; publish them with AtomicFile.

#include "app/render/image.hpp"
#include "claystack/core/result.hpp"

#include <cstddef>
#include <cstdint>
#include <functional>
#include <string>
#include <string_view>

namespace clay::render {

/// RGBA, 8 bits. Requires at least one pixel. Throws std::bad_alloc, as all that returns strings.
std::string png_of(const Image& image);

/// Frame `index` of an animation, from 0.
using FrameSource = std::function<Result<Image>(std::size_t index)>;
/// Receives the bytes of a file in order.
using ByteSink = std::function<Result<void>(std::string_view bytes)>;

/// Frames that `write_gif` requests before the first: the palette is chosen from this many, evenly
/// spaced, or from all if there are fewer.
[[nodiscard]] std::size_t palette_frames(std::size_t frames) noexcept;

/// An endless animation. Ignores alpha; all frames share one palette of 256 colours. Requires at
/// least one frame, all of one size. `delay_ms` between frames is rounded to 10. Requests the
/// frames for the palette, then all in order, and holds one at a time. Returns the number of bytes.
/// Errors are those of `frame_at` and `sink`, and of giflib.
Result<std::uint64_t> write_gif(std::size_t frames, int delay_ms, const FrameSource& frame_at,
                                const ByteSink& sink);

}  // namespace clay::render
