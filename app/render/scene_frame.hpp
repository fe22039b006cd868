#pragma once
// What the stages of one frame share, reckoned once.

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
  glm::vec2 sweep;  ///< azimuths that the cut leaves
  double px_per_mm;

  SceneFrame(const Picture& shown, Viewport viewport);
  /// So many that a circle of that radius looks like one.
  [[nodiscard]] int sectors_for(double radius_mm) const;
  [[nodiscard]] bool from_above() const { return block.eye.y > 0.0f; }

 private:
  void fill_block(Viewport viewport);
};

}  // namespace clay::render
