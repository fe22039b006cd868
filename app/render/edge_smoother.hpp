#pragma once
// Smooth edges of a canvas without samples, before it is enlarged on the screen.

#include "app/render/gl_objects.hpp"

namespace clay::render {

/// Smooths along edges and sharpens across them, so that enlarged pixels show neither as blocks nor
/// as steps. Belongs to the context that was current in `create`.
class EdgeSmoother {
 public:
  static Result<EdgeSmoother> create();
  /// Both have one sample, and the same size. Changes framebuffer, viewport, program, texture and
  /// tests.
  void draw(const Canvas& from, const Canvas& into) const;

 private:
  Program program_;
  VertexArray nothing_;
};

}  // namespace clay::render
