#include "export/solid/surface_distance.hpp"

#include "core/cancel.hpp"
#include "core/parallel_parts.hpp"
#include "export/solid/triangle_tree.hpp"

#include <algorithm>
#include <cmath>

namespace clay::solid {
namespace {

double farthest_squared(const std::vector<glm::dvec3>& points, const TriangleMesh& mesh) {
  constexpr std::size_t kPartPoints = 4096;
  TriangleTree tree(mesh);
  tree.prepare_distances();
  std::vector<double> farthest((points.size() + kPartPoints - 1) / kPartPoints, 0.0);
  for_each_part(farthest.size(), [&](std::size_t part) {
    const std::size_t end = std::min(points.size(), (part + 1) * kPartPoints);
    for (std::size_t i = part * kPartPoints; i < end; ++i) {
      step_of_loop();
      farthest[part] =
          std::max(farthest[part], tree.boxes().squared_distance(TriangleTree::point(points[i])));
    }
  });
  return farthest.empty() ? 0.0 : *std::max_element(farthest.begin(), farthest.end());
}

}  // namespace

double distance_to_surface(const std::vector<glm::dvec3>& points, const TriangleMesh& mesh) {
  return std::sqrt(farthest_squared(points, mesh));
}

double surface_distance(const TriangleMesh& a, const TriangleMesh& b) {
  return std::max(distance_to_surface(a.points, b), distance_to_surface(b.points, a));
}

}  // namespace clay::solid
