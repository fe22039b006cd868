#include "export/repair/intersecting_pairs.hpp"

#include "core/cancel.hpp"
#include "core/parallel_parts.hpp"
#include "export/proof/near_pairs.hpp"
#include "export/proof/pair_test.hpp"

#include <algorithm>
#include <atomic>
#include <glm/common.hpp>
#include <limits>

namespace clay::solid::inline repair {
namespace {

/// The search in slabs across the longest side of the mesh, each with the triangles that reach into
/// it, on all cores.
class PairSearch {
 public:
  explicit PairSearch(const TriangleMesh& mesh) : mesh_(mesh), test_(mesh) {
    glm::dvec3 low(std::numeric_limits<double>::infinity()), high = -low;
    for (const Triangle& t : mesh.triangles)
      for (const std::uint32_t v : t) {
        low = glm::min(low, mesh.points[v]);
        high = glm::max(high, mesh.points[v]);
      }
    for (int axis = 1; axis < 3; ++axis)
      if (high[axis] - low[axis] > high[axis_] - low[axis_]) axis_ = axis;
    choose_begins();
    distribute();
  }

  std::vector<TrianglePair> run(std::size_t most) {
    std::vector<std::vector<TrianglePair>> found(members_.size());
    for_each_part(members_.size(), [&](std::size_t slab) { found[slab] = search(slab, most); });
    std::vector<TrianglePair> all;
    for (const auto& of_slab : found) all.insert(all.end(), of_slab.begin(), of_slab.end());
    std::sort(all.begin(), all.end());
    all.resize(std::min(all.size(), most));
    return all;
  }

 private:
  [[nodiscard]] std::pair<double, double> reach(std::uint32_t t) const {
    const auto& [a, b, c] = mesh_.triangles[t];
    return std::minmax({mesh_.points[a][axis_], mesh_.points[b][axis_], mesh_.points[c][axis_]});
  }

  /// Slabs of about equally many triangles.
  void choose_begins() {
    constexpr std::size_t kSlabTriangles = 1 << 16, kMostSlabs = 16;
    const std::size_t slabs =
        std::clamp<std::size_t>(mesh_.triangles.size() / kSlabTriangles, 1, kMostSlabs);
    std::vector<double> lows(mesh_.triangles.size());
    for (std::uint32_t t = 0; t < lows.size(); ++t) lows[t] = reach(t).first;
    begins_.push_back(-std::numeric_limits<double>::infinity());
    for (std::size_t slab = 1; slab < slabs; ++slab) {
      const auto at = lows.begin() + static_cast<std::ptrdiff_t>(slab * lows.size() / slabs);
      std::nth_element(lows.begin(), at, lows.end());
      if (*at > begins_.back()) begins_.push_back(*at);
    }
  }

  /// If many triangles reach into several slabs, there is one.
  void distribute() {
    members_.resize(begins_.size());
    std::size_t entries = 0;
    for (std::uint32_t t = 0; t < mesh_.triangles.size(); ++t) {
      step_of_loop();
      if (test_.degenerate(mesh_.triangles[t])) continue;
      const auto [low, high] = reach(t);
      const auto first = std::upper_bound(begins_.begin(), begins_.end(), low) - 1;
      for (auto slab = first; slab != begins_.end() && *slab <= high; ++slab) {
        members_[static_cast<std::size_t>(slab - begins_.begin())].push_back(t);
        ++entries;
      }
    }
    if (begins_.size() == 1 || entries <= 3 * mesh_.triangles.size() / 2) return;
    begins_.resize(1);
    members_.clear();
    distribute();
  }

  std::vector<TrianglePair> search(std::size_t slab, std::size_t most) {
    std::vector<BoundingHull> bodies;
    bodies.reserve(members_[slab].size());
    for (const std::uint32_t t : members_[slab]) {
      const auto& [a, b, c] = mesh_.triangles[t];
      bodies.push_back({{mesh_.points[a], mesh_.points[b], mesh_.points[c], mesh_.points[c]},
                        0.0,
                        {kNoHub, kNoHub, kNoHub},
                        t,
                        reach(t).first < begins_[slab]});
    }
    members_[slab] = {};
    std::vector<TrianglePair> found;
    if (bodies.empty() || count_ >= most) return found;
    NearPairs near(std::move(bodies));
    near.for_each([&](std::uint32_t i, std::uint32_t j) {
      // A pair that reaches several slabs belongs to the first of them.
      if (near[i].early && near[j].early) return true;
      const auto [a, b] = std::minmax(near[i].number, near[j].number);
      if (!test_.meet(mesh_.triangles[a], mesh_.triangles[b])) return count_ < most;
      found.emplace_back(a, b);
      return ++count_ < most;
    });
    return found;
  }

  const TriangleMesh& mesh_;
  PairTest test_;
  int axis_ = 0;
  std::vector<double> begins_;                       ///< of the slabs, along the axis
  std::vector<std::vector<std::uint32_t>> members_;  ///< triangles by slab
  std::atomic<std::size_t> count_{0};                ///< pairs found in all slabs
};

}  // namespace

std::vector<TrianglePair> intersecting_pairs(const TriangleMesh& mesh, std::size_t most) {
  return mesh.triangles.empty() ? std::vector<TrianglePair>() : PairSearch(mesh).run(most);
}

}  // namespace clay::solid::inline repair
