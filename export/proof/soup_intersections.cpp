#include "export/proof/soup_intersections.hpp"

#include "core/cancel.hpp"
#include "export/proof/near_pairs.hpp"
#include "export/proof/pair_test.hpp"

#include <algorithm>
#include <glm/common.hpp>
#include <limits>
#include <utility>
#include <vector>

namespace clay::solid::inline proof {
namespace {

/// Approximate number of triangles per slab: few enough to stay in the cache.
constexpr std::size_t kSlabTriangles = 1 << 15;
constexpr std::size_t kMostSlabs = 256;

/// The axis along which the points extend most.
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

SoupIntersections::SoupIntersections(const TriangleMesh& mesh)
    : mesh_(mesh), axis_(longest_axis(mesh)) {
  set_degenerate_aside();
  hubs_ = HighValenceVertices(mesh, spread_);
  group_hubs();
  choose_begins();
  while (!distribute()) halve_slabs();
  found_.resize(groups_.size() - 1 + begins_.size());
}

void SoupIntersections::set_degenerate_aside() {
  const PairTest test(mesh_);
  spread_.reserve(mesh_.triangles.size());
  for (std::uint32_t t = 0; t < mesh_.triangles.size(); ++t) {
    step_of_loop();
    if (test.degenerate(mesh_.triangles[t]))
      note(degenerate_, {t}, {});
    else
      spread_.push_back(t);
  }
}

/// Groups hubs so that a group has at least about the triangles of a slab.
void SoupIntersections::group_hubs() {
  std::size_t triangles = 0;
  groups_.push_back(0);
  for (std::size_t hub = 0; hub < hubs_.size(); ++hub) {
    triangles += hubs_.triangles(hub).size();
    if (triangles < kSlabTriangles && hub + 1 < hubs_.size()) continue;
    groups_.push_back(hub + 1);
    triangles = 0;
  }
}

/// Chooses slabs with about equally many triangles, by the lowest corners of a regular sample.
void SoupIntersections::choose_begins() {
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

/// Returns false if the lists would grow too long.
bool SoupIntersections::distribute() {
  const std::size_t most = 2 * spread_.size() + kSlabTriangles;
  std::size_t entries = 0;
  members_.assign(begins_.size(), {});
  for (const std::uint32_t t : spread_) {
    step_of_loop();
    const auto [low, high] = reach(mesh_.triangles[t]);
    for (std::size_t slab = slab_of(low); slab < begins_.size() && begins_[slab] <= high; ++slab) {
      if (++entries > most) return false;
      members_[slab].push_back(t);
    }
  }
  spread_ = {};
  return true;
}

/// Joins slabs in pairs: if many triangles are long, fewer of them are in several wider slabs.
void SoupIntersections::halve_slabs() {
  for (std::size_t slab = 1; 2 * slab < begins_.size(); ++slab) begins_[slab] = begins_[2 * slab];
  begins_.resize((begins_.size() + 1) / 2);
}

void SoupIntersections::search(std::size_t part) {
  CrossingCount count;
  search(part, count);
  found_[part] = count.found;
}

void SoupIntersections::search(std::size_t part, PairSink& sink) {
  const std::size_t groups = groups_.size() - 1;
  if (part < groups)
    search_hubs(part, sink);
  else
    search_slab(part - groups, sink);
}

void SoupIntersections::search_hubs(std::size_t group, PairSink& sink) const {
  for (std::size_t hub = groups_[group]; hub < groups_[group + 1]; ++hub)
    if (!find_crossings_about(mesh_, hubs_, hub, sink)) return;
}

void SoupIntersections::search_slab(std::size_t slab, PairSink& sink) {
  const double begin = begins_[slab];
  std::vector<BoundingHull> bodies;
  bodies.reserve(members_[slab].size());
  for (const std::uint32_t t : members_[slab]) {
    const auto& [a, b, c] = mesh_.triangles[t];
    const auto hub = [&](std::uint32_t v) { return hubs_.is_hub(v) ? v : kNoHub; };
    bodies.push_back({{mesh_.points[a], mesh_.points[b], mesh_.points[c], mesh_.points[c]},
                      0.0,
                      {hub(a), hub(b), hub(c)},
                      t,
                      reach(mesh_.triangles[t]).first < begin});
  }
  members_[slab] = {};
  const PairTest test(mesh_);
  NearPairs near(std::move(bodies));
  near.for_each([&](std::uint32_t i, std::uint32_t j) {
    // A pair that reaches several slabs is counted in the first of them.
    if (near[i].early && near[j].early) return true;
    const std::uint32_t a = near[i].number, b = near[j].number;
    return !test.meet(mesh_.triangles[a], mesh_.triangles[b]) || sink.add(a, b);
  });
}

Fault SoupIntersections::found() const {
  Crossings all;
  for (const Crossings& part : found_) all.add(part);
  Fault fault;
  if (all.count > 0) note(fault, {all.first.first, all.first.second}, {});
  fault.count = all.count;
  return fault;
}

std::pair<double, double> SoupIntersections::reach(const Triangle& t) const {
  return std::minmax(
      {mesh_.points[t[0]][axis_], mesh_.points[t[1]][axis_], mesh_.points[t[2]][axis_]});
}

std::size_t SoupIntersections::slab_of(double low) const {
  const auto after = std::upper_bound(begins_.begin(), begins_.end(), low);
  return static_cast<std::size_t>(after - begins_.begin()) - 1;
}

}  // namespace clay::solid::inline proof
