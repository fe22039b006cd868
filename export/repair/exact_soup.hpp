#pragma once
// Triangles that meet only in whole edges and vertices, on exact points. Requires CGAL's headers:
// for the sources of this room only.

#include "export/solid/exact_point.hpp"
#include "export/solid/mesh_topology.hpp"

#include <vector>

namespace clay::solid::inline repair {

using ExactKernel = CGAL::Exact_predicates_exact_constructions_kernel;
using ExactPoint = ExactKernel::Point_3;

inline ExactPoint exact_point(const glm::dvec3& p) { return {p.x, p.y, p.z}; }

struct ExactSoup {
  std::vector<glm::dvec3> points;  ///< those of the input, then the new ones, nearest doubles
  std::size_t first_new = 0;
  std::vector<ExactPoint> exact;  ///< of the new points
  std::vector<Triangle> triangles;
  /// By triangle, at least 1: number of sheets of the input that cover it in its direction, minus
  /// those that cover it in the opposite one.
  std::vector<int> sheets;
  std::vector<bool> at_cut;  ///< by point of the input: whether a triangle that was cut uses it

  [[nodiscard]] ExactPoint point(std::uint32_t v) const {
    return v < first_new ? exact_point(points[v]) : exact[v - first_new];
  }
};

}  // namespace clay::solid::inline repair
