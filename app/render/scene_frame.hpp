#pragma once
// Values shared by the stages of one frame, computed once.

#include "app/render/look.hpp"
#include "app/render/picture.hpp"
#include "app/render/shaders.hpp"
#include "app/render/shadow.hpp"

#include <glm/vec2.hpp>
#include <vector>

namespace clay::render {

struct SceneFrame {
  const Picture& picture;
  const Look& look;
  FrameBlock block;
  std::vector<Body> bodies;
  double wheel_radius;
  glm::vec2 sweep;  ///< azimuths left by the cut
  double px_per_mm;

  SceneFrame(const Picture& shown, Viewport viewport);
  /// Enough sectors for a circle of that radius to look round.
  [[nodiscard]] int sectors_for(double radius_mm) const;
  [[nodiscard]] bool from_above() const { return block.eye.y > 0.0f; }

 private:
  void fill_block(Viewport viewport);
};

}  // namespace clay::render
