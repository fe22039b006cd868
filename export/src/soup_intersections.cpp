#include "mesh_geometry.hpp"

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/box_intersection_d.h>
#include <CGAL/intersections.h>
#include <algorithm>
#include <vector>

namespace clay::solid {
namespace {

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Point = Kernel::Point_3;
// CGAL copies the boxes and tells a box from its copy by its number: the default, its address,
// would lose pairs.
using Box = CGAL::Box_intersection_d::Box_with_info_d<double, 3, std::uint32_t,
                                                      CGAL::Box_intersection_d::ID_EXPLICIT>;

struct EnoughFound {};

class PairTest {
 public:
  explicit PairTest(const TriangleMesh& mesh) : mesh_(mesh) {}

  bool degenerate(const Triangle& t) const {
    return CGAL::collinear(point(t[0]), point(t[1]), point(t[2]));
  }
  CGAL::Bbox_3 bounds(const Triangle& t) const {
    return point(t[0]).bbox() + point(t[1]).bbox() + point(t[2]).bbox();
  }

  bool meet(Triangle a, Triangle b) const {
    switch (bring_shared_to_front(a, b)) {
      case 0:
        return CGAL::do_intersect(whole(a), whole(b));
      case 1:
        return CGAL::do_intersect(whole(a), last_side(b)) ||
               CGAL::do_intersect(whole(b), last_side(a));
      case 2:
        return CGAL::coplanar(point(a[0]), point(a[1]), point(a[2]), point(b[2])) &&
               CGAL::coplanar_orientation(point(a[0]), point(a[1]), point(a[2]), point(b[2])) ==
                   CGAL::POSITIVE;
      default:
        return false;
    }
  }

 private:
  Point point(std::uint32_t vertex) const {
    const glm::dvec3& p = mesh_.points[vertex];
    return {p.x, p.y, p.z};
  }
  Kernel::Triangle_3 whole(const Triangle& t) const {
    return {point(t[0]), point(t[1]), point(t[2])};
  }
  Kernel::Segment_3 last_side(const Triangle& t) const { return {point(t[1]), point(t[2])}; }

  static std::size_t bring_shared_to_front(Triangle& a, Triangle& b) {
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

  const TriangleMesh& mesh_;
};

}  // namespace

Fault degenerate_triangles(const TriangleMesh& mesh) {
  const PairTest test(mesh);
  Fault fault;
  for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t)
    if (test.degenerate(mesh.triangles[t])) note(fault, {t}, {});
  return fault;
}

Fault soup_self_intersections(const TriangleMesh& mesh) {
  const PairTest test(mesh);
  std::vector<Box> boxes;
  boxes.reserve(mesh.triangles.size());
  for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t)
    if (!test.degenerate(mesh.triangles[t])) boxes.emplace_back(test.bounds(mesh.triangles[t]), t);
  Fault fault;
  const auto count = [&](const Box& a, const Box& b) {
    if (!test.meet(mesh.triangles[a.info()], mesh.triangles[b.info()])) return;
    note(fault, {a.info(), b.info()}, {});
    if (fault.count == kMaxSelfIntersections) throw EnoughFound{};
  };
  try {
    CGAL::box_self_intersection_d(boxes.begin(), boxes.end(), count);
  } catch (const EnoughFound&) {
    // The count says it: there is no other way out of CGAL's traversal.
  }
  return fault;
}

}  // namespace clay::solid
