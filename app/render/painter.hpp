#pragma once
// Draws pictures with OpenGL 3.3 core.
//
// The steps from a pot to its picture: `view_of` makes rows of its rings, `levels_of` a section of
// the rows, and `meridian_of` a line of the section, which a vertex shader revolves. ScenePainter
// draws a frame in stages, Painter adds samples, Offscreen has a context without a screen, and
// pot_picture.hpp makes the pictures of files.

#include "app/render/picture.hpp"
#include "claystack/core/result.hpp"

#include <memory>

namespace clay::render {

/// Belongs to the context that was current in `create`, which must be current in every call and in
/// the destructor. Changes viewport, program, buffers and tests; keeps the framebuffer binding.
class Painter {
 public:
  /// `device`: the context is older than OpenGL 3.3, or its compiler refuses a shader.
  static Result<Painter> create();
  Painter(Painter&&) noexcept;
  Painter& operator=(Painter&&) noexcept;
  ~Painter();

  /// Draws the whole picture with background into the bound framebuffer, from its lower left
  /// corner. Colours are written as sRGB values: leave GL_FRAMEBUFFER_SRGB off. `samples` above 1:
  /// draws into its own multisampled buffer first, for a framebuffer without samples; 0 or 1: draws
  /// directly. With a software renderer (llvmpipe), four samples take more than twice the time: use
  /// none while things move.
  void paint(const Picture& picture, int width_px, int height_px, int samples) noexcept;
  /// Draws these rows of the whole picture only. All rows in turn make the same picture.
  void paint_rows(const Picture& picture, int width_px, int height_px, int samples,
                  PixelRows rows) noexcept;
  /// The same for a framebuffer that holds these rows only: a large picture needs little memory of
  /// the driver, strip by strip.
  void paint_strip(const Picture& picture, int width_px, int height_px, int samples,
                   PixelRows strip) noexcept;

  /// Draws a small hidden picture, because drivers compile a part of each program at its first use.
  /// Returns whether another one is left. Changes the same as `paint`.
  bool warm_up() noexcept;

 private:
  struct State;
  explicit Painter(std::unique_ptr<State> state);
  std::unique_ptr<State> state_;
};

}  // namespace clay::render
