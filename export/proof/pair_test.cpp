#include "export/proof/pair_test.hpp"

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/intersections.h>
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <utility>

namespace clay::solid::inline proof {
namespace {

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using CgalPoint = Kernel::Point_3;

CgalPoint cgal_point(const TriangleMesh& mesh, std::uint32_t vertex) {
  const glm::dvec3& p = mesh.points[vertex];
  return {p.x, p.y, p.z};
}

Kernel::Triangle_3 whole(const TriangleMesh& mesh, const Triangle& t) {
  return {cgal_point(mesh, t[0]), cgal_point(mesh, t[1]), cgal_point(mesh, t[2])};
}

Kernel::Segment_3 last_side(const TriangleMesh& mesh, const Triangle& t) {
  return {cgal_point(mesh, t[1]), cgal_point(mesh, t[2])};
}

/// True if the last side of `b` is on one side of the plane of `a`. Then `b` has no more than the
/// first corner, which both share, in that plane.
bool leaves_plane(const TriangleMesh& mesh, const Triangle& a, const Triangle& b) {
  const CgalPoint p = cgal_point(mesh, a[0]), q = cgal_point(mesh, a[1]),
                  r = cgal_point(mesh, a[2]);
  const CGAL::Orientation side = CGAL::orientation(p, q, r, cgal_point(mesh, b[1]));
  return side != CGAL::COPLANAR && side == CGAL::orientation(p, q, r, cgal_point(mesh, b[2]));
}

// Most pairs share a corner and lie side by side. A plane between them that is certain despite
// rounding spares such pairs the exact predicates, which are slow where four points are coplanar.
// The filters only ever answer "apart"; every other answer is left to the exact test.

/// A sum of products of differences is certain beyond this part of the sum of their absolute
/// values: four roundings in sequence are at most 4 * 2^-52 in any rounding mode, and half of the
/// bound is left for the rounding of the absolute values. Underflow changes it by less than `min`.
/// Overflow makes the comparison false.
bool certain(double sum, double absolute) {
  return std::abs(sum) > 0x1p-49 * absolute + std::numeric_limits<double>::min();
}

double sum_of_sizes(const glm::dvec3& v) { return std::abs(v.x) + std::abs(v.y) + std::abs(v.z); }

/// Side of the plane through `origin` with that normal on which the point certainly is: 1, -1, or 0
/// if that is not certain. Any vector is a normal, so its own rounding does not matter.
int side_of_plane(const glm::dvec3& normal, const glm::dvec3& origin, const glm::dvec3& point) {
  const glm::dvec3 terms = normal * (point - origin);
  const double sum = terms.x + terms.y + terms.z;
  return certain(sum, sum_of_sizes(terms)) ? (sum > 0.0 ? 1 : -1) : 0;
}

/// Side of the line from `v` to `w` on which a point certainly is, seen along an axis.
int side_of_line(std::size_t axis, const glm::dvec3& v, const glm::dvec3& w, const glm::dvec3& p) {
  const auto x = static_cast<int>((axis + 1) % 3), y = static_cast<int>((axis + 2) % 3);
  const double left = (w[x] - v[x]) * (p[y] - v[y]), right = (w[y] - v[y]) * (p[x] - v[x]);
  return certain(left - right, std::abs(left) + std::abs(right)) ? (left > right ? 1 : -1) : 0;
}

/// True if a plane through the first corner, which both share, has all else of `a` on one side and
/// all else of `b` on the other: the plane across the directions in which they leave the corner.
bool apart_at_corner(const TriangleMesh& mesh, const Triangle& a, const Triangle& b) {
  const glm::dvec3& origin = mesh.points[a[0]];
  const auto middle = [&](const Triangle& t) {
    const glm::dvec3 left = mesh.points[t[1]] - origin, right = mesh.points[t[2]] - origin;
    return sum_of_sizes(right) * left + sum_of_sizes(left) * right;
  };
  const glm::dvec3 of_a = middle(a), of_b = middle(b),
                   normal = sum_of_sizes(of_b) * of_a - sum_of_sizes(of_a) * of_b;
  const auto on = [&](int side, const Triangle& t) {
    return side_of_plane(normal, origin, mesh.points[t[1]]) == side &&
           side_of_plane(normal, origin, mesh.points[t[2]]) == side;
  };
  return on(1, a) && on(-1, b);
}

/// True if a plane through the first side, which both share, and parallel to an axis has the third
/// corners on opposite sides.
bool apart_at_side(const TriangleMesh& mesh, const Triangle& a, const Triangle& b) {
  const glm::dvec3 &v = mesh.points[a[0]], &w = mesh.points[a[1]];
  for (std::size_t axis = 0; axis < 3; ++axis)
    if (side_of_line(axis, v, w, mesh.points[a[2]]) * side_of_line(axis, v, w, mesh.points[b[2]]) <
        0)
      return true;
  return false;
}

std::size_t bring_shared_to_front(Triangle& a, Triangle& b) {
  std::size_t shared = 0;
  for (std::size_t i = 0; i < 3; ++i) {
    const auto twin = std::find(b.begin() + static_cast<std::ptrdiff_t>(shared), b.end(), a[i]);
    if (twin == b.end()) continue;
    std::swap(a[i], a[shared]);
    std::swap(*twin, b[shared]);
    ++shared;
  }
  return shared;
}

}  // namespace

bool PairTest::degenerate(const Triangle& t) const {
  return CGAL::collinear(cgal_point(mesh_, t[0]), cgal_point(mesh_, t[1]), cgal_point(mesh_, t[2]));
}

bool PairTest::meet(Triangle a, Triangle b) const {
  switch (bring_shared_to_front(a, b)) {
    case 0:
      return CGAL::do_intersect(whole(mesh_, a), whole(mesh_, b));
    case 1:
      if (apart_at_corner(mesh_, a, b)) return false;
      if (leaves_plane(mesh_, a, b) || leaves_plane(mesh_, b, a)) return false;
      return CGAL::do_intersect(whole(mesh_, a), last_side(mesh_, b)) ||
             CGAL::do_intersect(whole(mesh_, b), last_side(mesh_, a));
    case 2:
      return !apart_at_side(mesh_, a, b) && quarter(a[0], a[1], a[2], b[2]) == 0;
    default:
      return false;
  }
}

int PairTest::quarter(std::uint32_t v, std::uint32_t w, std::uint32_t p, std::uint32_t q) const {
  if (p == q) return 0;
  const CgalPoint origin = cgal_point(mesh_, v), end = cgal_point(mesh_, w);
  const CgalPoint from = cgal_point(mesh_, p), to = cgal_point(mesh_, q);
  switch (CGAL::orientation(origin, end, from, to)) {
    case CGAL::POSITIVE:
      return 1;
    case CGAL::NEGATIVE:
      return 3;
    default:
      return CGAL::coplanar_orientation(origin, end, from, to) == CGAL::POSITIVE ? 0 : 2;
  }
}

}  // namespace clay::solid::inline proof
