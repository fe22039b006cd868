#pragma once
// How much of the sky the walls of a pot leave to a place on it: the ambient light of its shading.

#include <glm/vec2.hpp>
#include <vector>

namespace clay::render {

struct Level;

struct SeenSky {
  float open = 1.0f;     ///< 0 none, 1 all that would be seen without the walls above
  glm::vec2 neck{0.0f};  ///< narrowest ring above: radius, height [mm]; radius 0: closed above
};

/// In the plane of the section: an arc of sky between the walls on both sides of the axis, weighted
/// by the cosine to an upright wall or a level floor.
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
