#include "export/solid/vertex_distance.hpp"

#include "core/cancel.hpp"

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Orthogonal_k_neighbor_search.h>
#include <CGAL/Search_traits_3.h>
#include <algorithm>
#include <cmath>
#include <vector>

namespace clay::solid {
namespace {

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Search = CGAL::Orthogonal_k_neighbor_search<CGAL::Search_traits_3<Kernel>>;

std::vector<Kernel::Point_3> points_of(const TriangleMesh& mesh) {
  std::vector<Kernel::Point_3> points;
  points.reserve(mesh.points.size());
  for (const glm::dvec3& p : mesh.points) points.emplace_back(p.x, p.y, p.z);
  return points;
}

double farthest_squared(const std::vector<Kernel::Point_3>& from,
                        const std::vector<Kernel::Point_3>& to) {
  const Search::Tree tree(to.begin(), to.end());
  double farthest = 0.0;
  for (const Kernel::Point_3& p : from) {
    step_of_loop();
    farthest = std::max(farthest, Search(tree, p, 1).begin()->second);
  }
  return farthest;
}

}  // namespace

double vertex_distance(const TriangleMesh& a, const TriangleMesh& b) {
  const auto in_a = points_of(a), in_b = points_of(b);
  return std::sqrt(std::max(farthest_squared(in_a, in_b), farthest_squared(in_b, in_a)));
}

}  // namespace clay::solid
