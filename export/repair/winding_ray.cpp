#include "export/repair/winding_ray.hpp"

#include <cmath>

namespace clay::solid::inline repair {
namespace {

using Point2 = ExactKernel::Point_2;

Point2 seen_along(int axis, const ExactPoint& p) { return {p[(axis + 1) % 3], p[(axis + 2) % 3]}; }

/// Number of counterclockwise turns of the corners around a point. Points on the border of two
/// triangles belong to one of them, as if moved by an infinitesimal.
int turns_around(const Point2& middle, const std::array<Point2, 3>& corners) {
  int turns = 0;
  for (std::size_t c = 0; c < 3; ++c) {
    const Point2 &a = corners.at(c), &b = corners.at((c + 1) % 3);
    const bool from_below = a.y() <= middle.y(), to_below = b.y() <= middle.y();
    if (from_below == to_below) continue;
    const CGAL::Orientation side = CGAL::orientation(a, b, middle);
    if (from_below && side == CGAL::LEFT_TURN) ++turns;
    if (to_below && side == CGAL::RIGHT_TURN) --turns;
  }
  return turns;
}

}  // namespace

int longest_axis_of(const ExactKernel::Vector_3& v) {
  int longest = 0;
  for (int axis = 1; axis < 3; ++axis)
    if (CGAL::abs(v[axis]) > CGAL::abs(v[longest])) longest = axis;
  return longest;
}

int WindingRay::crossing(const Triangle& triangle, const ExactPoint& from, int axis,
                         bool up) const {
  std::array<ExactPoint, 3> at;
  std::array<Point2, 3> flat;
  for (std::size_t c = 0; c < 3; ++c) {
    at.at(c) = exact_point(mesh_.points[triangle.at(c)]);
    flat.at(c) = seen_along(axis, at.at(c));
  }
  const int turns = turns_around(seen_along(axis, from), flat);
  if (turns == 0) return 0;
  const int side = static_cast<int>(CGAL::orientation(at[0], at[1], at[2], from));
  if (up) return side * turns < 0 ? turns : 0;
  return side * turns > 0 ? -turns : 0;  // above and below, the turns of a closed sheet cancel
}

WindingRay::Count WindingRay::from_middle_of(const std::array<ExactPoint, 3>& triangle) const {
  const ExactKernel::Vector_3 normal = CGAL::normal(triangle[0], triangle[1], triangle[2]);
  const int axis = longest_axis_of(normal);
  Count count{0, CGAL::sign(normal[axis]) == CGAL::POSITIVE};
  for (const Crossing& crossed :
       crossings(CGAL::centroid(triangle[0], triangle[1], triangle[2]), axis, true))
    count.winding += crossed.winding;
  return count;
}

std::vector<Crossing> WindingRay::crossings(const ExactPoint& from, int axis, bool up) const {
  const glm::dvec3 near = cgal::doubles_of(from);
  // The nearest double may lie just outside of a box that the exact point is in.
  const double margin = 1e-12 * (1.0 + std::abs(near.x) + std::abs(near.y) + std::abs(near.z));
  const int u = (axis + 1) % 3, v = (axis + 2) % 3;
  const auto entry = [&](const BoxTree::Box& box) {
    const bool behind =
        up ? near[axis] > box.high[axis] + margin : near[axis] < box.low[axis] - margin;
    const bool beside = behind || near[u] < box.low[u] - margin || near[u] > box.high[u] + margin ||
                        near[v] < box.low[v] - margin || near[v] > box.high[v] + margin;
    return beside ? BoxTree::kNever : 0.0;
  };
  std::vector<Crossing> crossed;
  tree_.for_each_near(
      entry, [] { return 0.0; },
      [&](std::span<const std::uint32_t> triangles) {
        for (const std::uint32_t t : triangles) {
          const Triangle& corners = mesh_.triangles[t];
          const auto [low_u, high_u] =
              std::minmax({mesh_.points[corners[0]][u], mesh_.points[corners[1]][u],
                           mesh_.points[corners[2]][u]});
          const auto [low_v, high_v] =
              std::minmax({mesh_.points[corners[0]][v], mesh_.points[corners[1]][v],
                           mesh_.points[corners[2]][v]});
          if (near[u] < low_u - margin || near[u] > high_u + margin || near[v] < low_v - margin ||
              near[v] > high_v + margin)
            continue;
          if (const int winding = crossing(corners, from, axis, up); winding != 0)
            crossed.push_back({t, winding});
        }
      });
  return crossed;
}

}  // namespace clay::solid::inline repair
