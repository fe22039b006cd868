#include "export/repair/triangle_crossing.hpp"

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <algorithm>
#include <stdexcept>
#include <utility>

namespace clay::solid::inline repair {
namespace {

using PredicateKernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using PredicatePoint = PredicateKernel::Point_3;

/// A triangle and the sides of the other one's plane on which its corners lie.
struct Corner3 {
  Triangle vertices;
  std::array<PredicatePoint, 3> at;
  std::array<CGAL::Orientation, 3> side{};
  std::uint32_t number, plane;
};

Corner3 corners_of(const TriangleMesh& mesh, std::uint32_t t, std::uint32_t plane) {
  Corner3 result{mesh.triangles[t], {}, {}, t, plane};
  for (std::size_t c = 0; c < 3; ++c) {
    const glm::dvec3& p = mesh.points[result.vertices.at(c)];
    result.at.at(c) = {p.x, p.y, p.z};
  }
  return result;
}

void find_sides(Corner3& of, const Corner3& plane) {
  for (std::size_t c = 0; c < 3; ++c)
    of.side.at(c) = CGAL::orientation(plane.at[0], plane.at[1], plane.at[2], of.at.at(c));
}

void add(Common& common, const CrossingPoint& point) {
  for (std::size_t i = 0; i < common.points; ++i)
    if (common.ends.at(i).name == point.name) return;
  if (common.points == common.ends.size())
    throw std::logic_error("two triangles with three ends of their common segment");
  common.ends.at(common.points++) = point;
}

CrossingPoint vertex(std::uint32_t v) { return {{v, kNoPart, kNoPart, kNoPart}}; }

/// `p` lies in the plane of the triangle.
bool holds(const Corner3& triangle, const PredicatePoint& p) {
  for (std::size_t c = 0; c < 3; ++c)
    if (CGAL::coplanar_orientation(triangle.at.at(c), triangle.at.at((c + 1) % 3),
                                   triangle.at.at((c + 2) % 3), p) == CGAL::NEGATIVE)
      return false;
  return true;
}

/// The edge from corner `i` of one triangle crosses the plane of the other.
void add_crossing(Common& common, const Corner3& one, std::size_t i, const Corner3& other) {
  const std::size_t j = (i + 1) % 3;
  std::array<CGAL::Orientation, 3> turn{};
  for (std::size_t c = 0; c < 3; ++c)
    turn.at(c) =
        CGAL::orientation(one.at.at(i), one.at.at(j), other.at.at(c), other.at.at((c + 1) % 3));
  const auto has = [&](CGAL::Orientation sign) {
    return std::find(turn.begin(), turn.end(), sign) != turn.end();
  };
  if (has(CGAL::POSITIVE) && has(CGAL::NEGATIVE)) return;  // it passes beside the triangle
  const auto [from, to] = std::minmax(one.vertices.at(i), one.vertices.at(j));
  CrossingPoint point{{from, to, other.plane, kNoPart}, from, to, other.number};
  for (std::size_t c = 0; c < 3; ++c) {
    const std::size_t next = (c + 1) % 3;
    if (turn.at(c) != CGAL::COLLINEAR) continue;
    if (turn.at(next) == CGAL::COLLINEAR) return add(common, vertex(other.vertices.at(next)));
    const std::uint32_t a = other.vertices.at(c), b = other.vertices.at(next);
    const std::pair edge(from, to), crossed(std::min(a, b), std::max(a, b));
    const auto [low, high] = std::minmax(edge, crossed);
    point.name = {low.first, low.second, high.first, high.second};
  }
  add(common, point);
}

void add_ends(Common& common, const Corner3& one, const Corner3& other) {
  for (std::size_t i = 0; i < 3; ++i) {
    if (one.side.at(i) == CGAL::COPLANAR) {
      if (holds(other, one.at.at(i))) add(common, vertex(one.vertices.at(i)));
    } else if (one.side.at(i) == -one.side.at((i + 1) % 3)) {
      add_crossing(common, one, i, other);
    }
  }
}

}  // namespace

Common common_of(const TriangleMesh& mesh, std::uint32_t first, std::uint32_t second,
                 std::uint32_t plane_of_first, std::uint32_t plane_of_second) {
  Corner3 one = corners_of(mesh, first, plane_of_first);
  Corner3 other = corners_of(mesh, second, plane_of_second);
  find_sides(one, other);
  find_sides(other, one);
  Common common;
  add_ends(common, one, other);
  add_ends(common, other, one);
  return common;
}

}  // namespace clay::solid::inline repair
