// The parts of a mesh that neither stand on the bed nor touch a part that stands.

#include "claystack/export/check.hpp"

#include "export/proof/intersecting_pairs.hpp"
#include "export/solid/box_tree.hpp"
#include "export/solid/disjoint_sets.hpp"
#include "export/solid/ray_upward.hpp"

#include <algorithm>
#include <limits>
#include <unordered_map>
#include <utility>
#include <vector>

namespace clay::solid::inline check {
namespace {

/// Less than any printer's layer height: a smaller gap counts as contact.
constexpr double kContactMm = 0.05;
/// More pairs are not evaluated: such a mesh is no assembly of a few parts.
constexpr std::size_t kMostPairs = 1'000'000;
/// Of all rays together, in visited boxes and triangles.
constexpr std::size_t kMostRaySteps = 200'000'000;

/// Parts are sets of points that triangles join; contact joins them further.
class Parts {
 public:
  explicit Parts(const TriangleMesh& mesh)
      : mesh_(mesh), sets_(mesh.points.size()), lowest_(mesh.points.size(), kNone) {
    for (const auto& [a, b, c] : mesh.triangles) {
      sets_.unite(a, b);
      sets_.unite(a, c);
    }
    for_each_corner([&](std::uint32_t v) { bed_mm_ = std::min(bed_mm_, mesh_.points[v].z); });
    find_extremes();
    count_ = roots_.size();
  }

  std::optional<HangingParts> run(bool intersect) {
    if (all_stand()) return {};
    if (intersect && !join(intersecting_pairs(mesh_, kMostPairs))) return {};
    if (all_stand() || !join_enclosed(intersect)) return {};
    if (all_stand() || !join(intersecting_pairs(lowered(), kMostPairs))) return {};
    return hanging();
  }

 private:
  static constexpr std::uint32_t kNone = UINT32_MAX;

  template <class Visit>
  void for_each_corner(const Visit& visit) const {
    for (const auto& triangle : mesh_.triangles)
      for (const std::uint32_t v : triangle) visit(v);
  }

  /// After each union.
  void find_extremes() {
    std::ranges::fill(lowest_, kNone);
    roots_.clear();
    for_each_corner([&](std::uint32_t v) {
      std::uint32_t& lowest = lowest_[sets_.of(v)];
      if (lowest == kNone) roots_.push_back(sets_.of(v));
      if (lowest == kNone || mesh_.points[v].z < mesh_.points[lowest].z) lowest = v;
    });
  }

  [[nodiscard]] bool stands(std::uint32_t root) const {
    return mesh_.points[lowest_[root]].z <= bed_mm_ + kContactMm;
  }
  [[nodiscard]] bool all_stand() const {
    return std::ranges::all_of(roots_, [&](std::uint32_t root) { return stands(root); });
  }

  /// False: too many pairs to be complete.
  bool join(const std::vector<TrianglePair>& pairs) {
    for (const auto& [a, b] : pairs) sets_.unite(mesh_.triangles[a][0], mesh_.triangles[b][0]);
    find_extremes();
    return pairs.size() < kMostPairs;
  }

  /// The mesh with all hanging parts moved down: a part that rests on another one then meets it,
  /// even if rounding left a gap.
  [[nodiscard]] TriangleMesh lowered() {
    TriangleMesh mesh = mesh_;
    for (std::uint32_t v = 0; v < mesh.points.size(); ++v)
      if (const std::uint32_t root = sets_.of(v); lowest_[root] != kNone && !stands(root))
        mesh.points[v].z -= kContactMm;
    return mesh;
  }

  /// A shell in the clay of another part is one body with it: a cavity, or a shell that a slicer
  /// fills. False: too much work.
  bool join_enclosed(bool intersect) {
    const BoxTree tree(mesh_);
    std::unordered_map<std::uint32_t, std::uint32_t> highest;
    for_each_corner([&](std::uint32_t v) {
      const std::uint32_t root = sets_.of(v);
      if (stands(root)) return;
      const auto [top, first] = highest.try_emplace(root, v);
      if (mesh_.points[v].z > mesh_.points[top->second].z) top->second = v;
    });
    std::vector<std::pair<std::uint32_t, std::uint32_t>> inside;
    std::size_t steps = 0;
    for (const std::uint32_t root : roots_) {
      if (stands(root)) continue;
      RayUpward ray(mesh_, highest.at(root));
      const auto own = [&](std::uint32_t t) { return sets_.of(mesh_.triangles[t][0]) == root; };
      // If surfaces intersect, the nearest one does not decide whether the part is enclosed.
      const auto hit = intersect ? ray.enclosing_hit(tree, own) : ray.first_hit(tree, own);
      if (hit && hit->from_back) inside.emplace_back(root, mesh_.triangles[hit->triangle][0]);
      if ((steps += ray.steps()) > kMostRaySteps) return false;
    }
    for (const auto& [root, around] : inside) {
      if (sets_.of(root) != sets_.of(around)) --count_;
      sets_.unite(root, around);
    }
    find_extremes();
    return true;
  }

  [[nodiscard]] std::optional<HangingParts> hanging() const {
    HangingParts found{count_, 0, std::numeric_limits<double>::infinity()};
    for (const std::uint32_t root : roots_) {
      if (stands(root)) continue;
      ++found.hanging;
      found.lowest_mm = std::min(found.lowest_mm, mesh_.points[lowest_[root]].z - bed_mm_);
    }
    return found.hanging > 0 ? std::optional(found) : std::nullopt;
  }

  const TriangleMesh& mesh_;
  DisjointSets sets_;
  std::vector<std::uint32_t> lowest_;  ///< point, by set
  std::vector<std::uint32_t> roots_;
  std::size_t count_ = 0;  ///< before contact joined them; cavities do not count
  double bed_mm_ = std::numeric_limits<double>::infinity();
};

}  // namespace

std::optional<HangingParts> hanging_parts(const TriangleMesh& mesh, const MeshReport& report) {
  // Only of a mesh whose clay is known: the points are finite, the indices in range.
  if (!report.closed || !report.oriented || !report.has_volume || report.components < 2) return {};
  return Parts(mesh).run(report.self_intersections > 0);
}

}  // namespace clay::solid::inline check
