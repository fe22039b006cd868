#include "export/proof/pair_test.hpp"

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/intersections.h>
#include <algorithm>
#include <cstddef>
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
      if (leaves_plane(mesh_, a, b) || leaves_plane(mesh_, b, a)) return false;
      return CGAL::do_intersect(whole(mesh_, a), last_side(mesh_, b)) ||
             CGAL::do_intersect(whole(mesh_, b), last_side(mesh_, a));
    case 2:
      return quarter(a[0], a[1], a[2], b[2]) == 0;
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
