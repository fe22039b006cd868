#pragma once
#include "claystack/export/solid.hpp"

#include <glm/common.hpp>

namespace clay::solid {

/// Width, depth and height [mm] of the bounding box; requires at least one point.
[[nodiscard]] inline glm::dvec3 extent_of(const TriangleMesh& mesh) {
  glm::dvec3 low = mesh.points.front(), high = low;
  for (const glm::dvec3& p : mesh.points) {
    low = glm::min(low, p);
    high = glm::max(high, p);
  }
  return high - low;
}

}  // namespace clay::solid
