#pragma once
// Pictures without a screen: OpenGL through EGL without a surface.

#include "app/render/image.hpp"
#include "app/render/picture.hpp"
#include "claystack/core/result.hpp"

#include <memory>

namespace clay::render {

/// Largest side of a picture [px].
inline constexpr int kMaxSidePx = 8192;
inline constexpr int kSamples = 4;

/// Has its own context, which each call makes current. One thread at a time.
class Offscreen {
 public:
  /// `device`: no EGL, or none that draws OpenGL 3.3 without a surface; the message names what is
  /// missing.
  static Result<Offscreen> create();
  Offscreen(Offscreen&&) noexcept;
  Offscreen& operator=(Offscreen&&) noexcept;
  ~Offscreen();

  /// With kSamples per pixel. Requires sides from 1 to kMaxSidePx.
  Result<Image> draw(const Picture& picture, Viewport viewport);
  /// Draws without reading back, and waits for the end: the time [ms] of a frame.
  Result<double> time_ms(const Picture& picture, Viewport viewport, int samples);
  /// The renderer, for example "llvmpipe (LLVM 15.0.6, 256 bits)".
  [[nodiscard]] const std::string& renderer() const noexcept;

 private:
  struct State;
  explicit Offscreen(std::unique_ptr<State> state);
  std::unique_ptr<State> state_;
};

}  // namespace clay::render
