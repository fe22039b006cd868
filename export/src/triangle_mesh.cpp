#include "claystack/export/triangle_mesh.hpp"

#include "compensated_sum.hpp"

#include <glm/geometric.hpp>

namespace clay::solid {

double signed_volume(const TriangleMesh& mesh) noexcept {
  if (mesh.points.empty()) return 0.0;
  const glm::dvec3 origin = mesh.points.front();
  CompensatedSum sextuple;
  for (const auto& [a, b, c] : mesh.triangles)
    sextuple.add(glm::dot(mesh.points[a] - origin,
                          glm::cross(mesh.points[b] - origin, mesh.points[c] - origin)));
  return sextuple.value() / 6.0;
}

}  // namespace clay::solid
