#include "export/solid/ray_upward.hpp"

#include <CGAL/Exact_predicates_exact_constructions_kernel.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <algorithm>

namespace clay::solid {
namespace {

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Exact = CGAL::Exact_predicates_exact_constructions_kernel;

Kernel::Point_3 point(const glm::dvec3& p) { return {p.x, p.y, p.z}; }

/// The height of a triangle's plane above a point, and its slopes along x and y.
struct Height {
  Exact::FT z, along_x, along_y;

  Height(const TriangleMesh& mesh, std::uint32_t triangle, const glm::dvec3& place) {
    const auto exact = [&](std::uint32_t v) {
      const glm::dvec3& p = mesh.points[v];
      return Exact::Point_3(p.x, p.y, p.z);
    };
    const auto& [a, b, c] = mesh.triangles[triangle];
    const Exact::Point_3 origin = exact(a);
    const Exact::Vector_3 normal = CGAL::cross_product(exact(b) - origin, exact(c) - origin);
    along_x = -normal.x() / normal.z();
    along_y = -normal.y() / normal.z();
    z = origin.z() + along_x * (place.x - origin.x()) + along_y * (place.y - origin.y());
  }

  /// If triangles touch above the point itself, the slopes decide beside it.
  [[nodiscard]] bool below(const Height& other) const {
    if (z != other.z) return z < other.z;
    if (along_x != other.along_x) return along_x < other.along_x;
    return along_y < other.along_y;
  }
};

}  // namespace

template <class Use>
void RayUpward::for_each_hit(const BoxTree& tree,
                             const std::function<bool(std::uint32_t)>& passed_over,
                             const double& limit, const Use& use) {
  const auto entry = [&](const BoxTree::Box& box) {
    ++steps_;
    return enter(box);
  };
  tree.for_each_near(
      entry, [&] { return limit; },
      [&](std::span<const std::uint32_t> triangles) {
        for (const std::uint32_t t : triangles) {
          ++steps_;
          if (passed_over(t)) continue;
          if (const auto hit = meet(t)) use(*hit);
        }
      });
}

std::optional<RayUpward::Hit> RayUpward::first_hit(
    const BoxTree& tree, const std::function<bool(std::uint32_t)>& passed_over) {
  std::optional<Hit> first;
  std::optional<Height> lowest;
  double limit = std::numeric_limits<double>::max();  // of the nearest hit so far
  for_each_hit(tree, passed_over, limit, [&](const Hit& hit) {
    Height height(mesh_, hit.triangle, from_);
    if (lowest && !height.below(*lowest)) return;
    limit = CGAL::to_interval(height.z).second;
    lowest = std::move(height);
    first = hit;
  });
  return first;
}

std::optional<RayUpward::Hit> RayUpward::enclosing_hit(
    const BoxTree& tree, const std::function<bool(std::uint32_t)>& passed_over) {
  std::optional<Hit> left;
  int winding = 0;
  for_each_hit(tree, passed_over, std::numeric_limits<double>::max(), [&](const Hit& hit) {
    winding += hit.from_back ? 1 : -1;
    if (hit.from_back && !left) left = hit;
  });
  return winding > 0 ? left : std::nullopt;
}

/// The lowest height at which the ray can hit something in the box.
double RayUpward::enter(const BoxTree::Box& box) const {
  if (box.low.x > from_.x || from_.x > box.high.x || box.low.y > from_.y || from_.y > box.high.y)
    return BoxTree::kNever;
  double low = box.low.z, high = box.high.z;
  const double rise = box.across.z;
  const double begin = double{box.across.x} * from_.x + double{box.across.y} * from_.y;
  if (rise != 0.0) {
    const auto [first, last] = std::minmax({(box.from - begin) / rise, (box.to - begin) / rise});
    low = std::max(low, first);
    high = std::min(high, last);
  } else if (begin < box.from || begin > box.to) {
    return BoxTree::kNever;
  }
  return low <= high && from_.z <= high ? low : BoxTree::kNever;
}

/// Side of the point relative to the line from a to b, seen from above: 1 left, -1 right, 0 for a
/// degenerate line.
int RayUpward::side(const glm::dvec3& a, const glm::dvec3& b) const {
  const CGAL::Sign exactly = CGAL::orientation(Kernel::Point_2(a.x, a.y), Kernel::Point_2(b.x, b.y),
                                               Kernel::Point_2(from_.x, from_.y));
  if (exactly != CGAL::ZERO) return exactly;
  if (a.y != b.y) return a.y > b.y ? 1 : -1;
  return a.x == b.x ? 0 : a.x < b.x ? 1 : -1;
}

std::optional<RayUpward::Hit> RayUpward::meet(std::uint32_t triangle) const {
  const auto& [i, j, k] = mesh_.triangles[triangle];
  const glm::dvec3 &a = mesh_.points[i], &b = mesh_.points[j], &c = mesh_.points[k];
  if (std::max({a.x, b.x, c.x}) < from_.x || std::min({a.x, b.x, c.x}) > from_.x ||
      std::max({a.y, b.y, c.y}) < from_.y || std::min({a.y, b.y, c.y}) > from_.y ||
      std::max({a.z, b.z, c.z}) < from_.z)
    return std::nullopt;
  const int turn = side(a, b);
  if (turn == 0 || side(b, c) != turn || side(c, a) != turn) return std::nullopt;
  const CGAL::Sign front = CGAL::orientation(point(a), point(b), point(c), point(from_));
  // Below it: behind a triangle that faces up, in front of one that faces down.
  if (turn * front >= 0) return std::nullopt;
  return Hit{triangle, front == CGAL::NEGATIVE};
}

}  // namespace clay::solid
