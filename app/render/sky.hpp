#pragma once
// The fraction of the sky visible from a point between the walls of a pot: its ambient light.

#include <glm/vec2.hpp>
#include <vector>

namespace clay::render {

struct Level;

struct SeenSky {
  float open = 1.0f;     ///< 0 none, 1 as without the walls above
  glm::vec2 neck{0.0f};  ///< narrowest ring above: radius, height [mm]; radius 0: closed above
};

/// In the plane of the section: an arc of sky between the walls on both sides of the axis, weighted
/// by the cosine to a vertical wall or a horizontal floor.
class Sky {
 public:
  explicit Sky(const std::vector<Level>& levels);
  [[nodiscard]] float outside(glm::vec2 at) const;   ///< of the outer wall at (rho, y)
  [[nodiscard]] SeenSky inside(glm::vec2 at) const;  ///< of the bore

 private:
  struct Ring {
    float y, outer, inner;
  };
  std::vector<Ring> rings_;
};

}  // namespace clay::render
