#pragma once
// A framebuffer of a size that changes, for the view between the panels.

#include <glm/vec2.hpp>

namespace clay::studio {

/// Needs the context that was current when it was made. Colour and depth.
class GlCanvas {
 public:
  GlCanvas();
  ~GlCanvas();
  GlCanvas(const GlCanvas&) = delete;
  GlCanvas& operator=(const GlCanvas&) = delete;

  /// Bound for drawing, at this size.
  void bind(glm::ivec2 size_px);
  /// Copies it to `target`, whose height is `target_height_px`, with its upper left corner there.
  void copy_to(unsigned target, int target_height_px, glm::ivec2 corner_px) const;

 private:
  unsigned framebuffer_ = 0, colour_ = 0, depth_ = 0;
  glm::ivec2 size_px_{0};
};

}  // namespace clay::studio
