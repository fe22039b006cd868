#include "soup_intersections.hpp"

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/box_intersection_d.h>
#include <CGAL/intersections.h>
#include <algorithm>
#include <glm/common.hpp>
#include <limits>
#include <utility>
#include <vector>

namespace clay::solid {
namespace {

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Point = Kernel::Point_3;
using Box =
    CGAL::Box_intersection_d::Box_with_info_d<double, 3, std::uint32_t,
                                              CGAL::Box_intersection_d::ID_FROM_BOX_ADDRESS>;

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

struct EnoughFound {};

/// Triangles to a slab, about: few enough to stay near the processor.
constexpr std::size_t kSlabTriangles = 1 << 15;
constexpr std::size_t kMostSlabs = 256;
/// Below this CGAL compares all boxes of a set with one another (the cutoff of its own mesh test).
constexpr std::ptrdiff_t kCutoff = 2000;

/// The axis along which the points spread most.
int longest_axis(const TriangleMesh& mesh) {
  glm::dvec3 low = mesh.points.front(), high = low;
  for (const glm::dvec3& p : mesh.points) {
    low = glm::min(low, p);
    high = glm::max(high, p);
  }
  int longest = 0;
  for (int axis = 1; axis < 3; ++axis)
    if (high[axis] - low[axis] > high[longest] - low[longest]) longest = axis;
  return longest;
}

}  // namespace

SlabIntersections::SlabIntersections(const TriangleMesh& mesh)
    : mesh_(mesh), axis_(longest_axis(mesh)) {
  set_degenerate_aside();
  choose_begins();
  while (!distribute()) halve_slabs();
  found_.resize(begins_.size());
}

void SlabIntersections::set_degenerate_aside() {
  const PairTest test(mesh_);
  spread_.reserve(mesh_.triangles.size());
  for (std::uint32_t t = 0; t < mesh_.triangles.size(); ++t) {
    if (test.degenerate(mesh_.triangles[t]))
      note(degenerate_, {t}, {});
    else
      spread_.push_back(t);
  }
}

/// So that about as many triangles begin in each: by the lowest corners of a regular sample.
void SlabIntersections::choose_begins() {
  const std::size_t slabs =
      std::clamp<std::size_t>(mesh_.triangles.size() / kSlabTriangles, 1, kMostSlabs);
  const std::size_t step = std::max<std::size_t>(mesh_.triangles.size() / (64 * slabs), 1);
  std::vector<double> lows;
  for (std::size_t t = 0; t < mesh_.triangles.size(); t += step)
    lows.push_back(reach(mesh_.triangles[t]).first);
  std::sort(lows.begin(), lows.end());
  begins_.push_back(-std::numeric_limits<double>::infinity());
  for (std::size_t slab = 1; slab < slabs; ++slab) {
    const double begin = lows[slab * lows.size() / slabs];
    if (begin > begins_.back()) begins_.push_back(begin);
  }
}

/// False where the lists would grow too long.
bool SlabIntersections::distribute() {
  const std::size_t most = 2 * spread_.size() + kSlabTriangles;
  std::size_t entries = 0;
  members_.assign(begins_.size(), {});
  for (const std::uint32_t t : spread_) {
    const auto [low, high] = reach(mesh_.triangles[t]);
    for (std::size_t slab = slab_of(low); slab < begins_.size() && begins_[slab] <= high; ++slab) {
      if (++entries > most) return false;
      members_[slab].push_back(t);
    }
  }
  spread_ = {};
  return true;
}

/// Where many triangles reach far, wider slabs have fewer of them twice.
void SlabIntersections::halve_slabs() {
  for (std::size_t slab = 1; 2 * slab < begins_.size(); ++slab) begins_[slab] = begins_[2 * slab];
  begins_.resize((begins_.size() + 1) / 2);
}

void SlabIntersections::search(std::size_t slab) {
  const PairTest test(mesh_);
  std::vector<Box> boxes;
  boxes.reserve(members_[slab].size());
  for (const std::uint32_t t : members_[slab])
    boxes.emplace_back(test.bounds(mesh_.triangles[t]), t);
  members_[slab] = {};
  std::vector<const Box*> handles;
  handles.reserve(boxes.size());
  for (const Box& box : boxes) handles.push_back(&box);
  Crossings found;
  const auto count = [&](const Box* a, const Box* b) {
    // Of the slabs that both reach, the pair is counted in the first.
    if (slab_of(std::max(a->min_coord(axis_), b->min_coord(axis_))) != slab) return;
    if (!test.meet(mesh_.triangles[a->info()], mesh_.triangles[b->info()])) return;
    found.first = std::min(found.first, Pair(std::minmax(a->info(), b->info())));
    if (++found.count == kMaxSelfIntersections) throw EnoughFound{};
  };
  try {
    CGAL::box_self_intersection_d(handles.begin(), handles.end(), count, kCutoff);
  } catch (const EnoughFound&) {
    // The count says it: there is no other way out of CGAL's traversal.
  }
  found_[slab] = found;
}

Fault SlabIntersections::found() const {
  Crossings all;
  for (const Crossings& part : found_) {
    all.count = std::min(all.count + part.count, kMaxSelfIntersections);
    all.first = std::min(all.first, part.first);
  }
  Fault fault;
  if (all.count > 0) note(fault, {all.first.first, all.first.second}, {});
  fault.count = all.count;
  return fault;
}

std::pair<double, double> SlabIntersections::reach(const Triangle& t) const {
  return std::minmax(
      {mesh_.points[t[0]][axis_], mesh_.points[t[1]][axis_], mesh_.points[t[2]][axis_]});
}

std::size_t SlabIntersections::slab_of(double low) const {
  const auto after = std::upper_bound(begins_.begin(), begins_.end(), low);
  return static_cast<std::size_t>(after - begins_.begin()) - 1;
}

}  // namespace clay::solid
