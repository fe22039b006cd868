#pragma once
// Draws pictures with OpenGL 3.3 core.

#include "app/render/picture.hpp"
#include "claystack/core/result.hpp"

#include <memory>

namespace clay::render {

/// Bound to the context that was current in `create`: every call, and the destructor, need it
/// current. Leaves viewport, program, buffers and tests as it likes, the framebuffer as it was.
class Painter {
 public:
  /// `device`: the context is older than OpenGL 3.3, or its compiler refuses a shader.
  static Result<Painter> create();
  Painter(Painter&&) noexcept;
  Painter& operator=(Painter&&) noexcept;
  ~Painter();

  /// The whole picture, background and all, into the framebuffer that is bound for drawing, from
  /// its lower left corner on. Colours are written as sRGB values: leave GL_FRAMEBUFFER_SRGB off.
  /// `samples` above 1: into a multisampled buffer of its own first, for a framebuffer without
  /// samples; 0 or 1: straight into it. Where the processor itself draws (llvmpipe), four samples
  /// take more than twice the time: use none while things move.
  void paint(const Picture& picture, int width_px, int height_px, int samples) noexcept;

 private:
  struct State;
  explicit Painter(std::unique_ptr<State> state);
  std::unique_ptr<State> state_;
};

}  // namespace clay::render
