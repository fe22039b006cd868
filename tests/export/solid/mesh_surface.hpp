#pragma once
#include "claystack/export/solid.hpp"

#include <glm/geometric.hpp>

namespace clay::solid::shapes {

inline double surface_mm2(const TriangleMesh& mesh) {
  double doubled = 0.0;
  for (const auto& [a, b, c] : mesh.triangles)
    doubled +=
        glm::length(glm::cross(mesh.points[b] - mesh.points[a], mesh.points[c] - mesh.points[a]));
  return 0.5 * doubled;
}

}  // namespace clay::solid::shapes
