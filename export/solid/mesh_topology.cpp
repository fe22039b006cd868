#include "export/solid/mesh_topology.hpp"

#include "core/cancel.hpp"
#include "export/solid/disjoint_sets.hpp"

#include <algorithm>
#include <numeric>
#include <utility>

namespace clay::solid {
namespace {

std::uint32_t narrow(std::size_t n) { return static_cast<std::uint32_t>(n); }

/// A side of a triangle, stored with the lower vertex of its edge. Sides are numbered 3 * triangle
/// + corner, from that corner to the next.
struct Side {
  std::uint32_t high = 0;  ///< the other vertex of the edge
  std::uint32_t number = 0;
  friend auto operator<=>(const Side&, const Side&) = default;
};

/// All sides in buckets by lower vertex: a counting sort, because the buckets of a large mesh are
/// small and sorting all its edges is several times slower.
class SidesByVertex {
 public:
  SidesByVertex(std::size_t points, std::span<const Triangle> triangles) : begins_(points + 1, 0) {
    for_each_side(triangles, [&](std::uint32_t low, Side) { ++begins_[low]; });
    std::exclusive_scan(begins_.begin(), begins_.end(), begins_.begin(), std::uint32_t{0});
    sides_.resize(begins_.back());
    for_each_side(triangles, [&](std::uint32_t low, Side side) { sides_[begins_[low]++] = side; });
    // Every start has moved to its bucket's end, which is the start of the next.
    std::rotate(begins_.begin(), begins_.end() - 1, begins_.end());
    begins_.front() = 0;
  }

  std::span<Side> of(std::size_t vertex) {
    return std::span(sides_).subspan(begins_[vertex], begins_[vertex + 1] - begins_[vertex]);
  }

 private:
  template <class Visit>
  static void for_each_side(std::span<const Triangle> triangles, Visit visit) {
    for (std::size_t t = 0; t < triangles.size(); ++t) {
      step_of_loop();
      if (collapsed(triangles[t])) continue;
      for (std::size_t c = 0; c < 3; ++c) {
        const auto [low, high] = std::minmax(triangles[t][c], triangles[t][(c + 1) % 3]);
        visit(low, Side{high, narrow(3 * t + c)});
      }
    }
  }

  std::vector<std::uint32_t> begins_;  ///< by vertex, with the end of the last
  std::vector<Side> sides_;
};

class TopologyCount {
 public:
  TopologyCount(std::size_t points, std::span<const Triangle> triangles)
      : points_(points),
        triangles_(triangles),
        fans_(3 * triangles.size()),
        shells_(triangles.size()) {}

  MeshTopology run() {
    count_collapsed();
    count_edges();
    count_split_vertices();
    count_components();
    return std::move(found_);
  }

 private:
  std::uint32_t vertex(std::uint32_t corner) const { return triangles_[corner / 3][corner % 3]; }
  static std::uint32_t next(std::uint32_t corner) {
    return corner % 3 == 2 ? corner - 2 : corner + 1;
  }

  void count_collapsed() {
    for (std::size_t t = 0; t < triangles_.size(); ++t)
      if (collapsed(triangles_[t])) note(found_.collapsed, {narrow(t)}, {});
  }

  void count_edges() {
    SidesByVertex sides(points_, triangles_);
    for (std::size_t low = 0; low < points_; ++low) {
      step_of_loop();
      const std::span<Side> bucket = sides.of(low);
      std::sort(bucket.begin(), bucket.end());
      for (auto begin = bucket.begin(); begin != bucket.end();) {
        const auto end = std::find_if(begin, bucket.end(),
                                      [&](const Side& side) { return side.high != begin->high; });
        count_edge(narrow(low), {begin, end});
        begin = end;
      }
    }
  }

  void count_edge(std::uint32_t low, std::span<const Side> sides) {
    for (const Side& side : sides.subspan(1)) join(sides.front().number, side.number);
    const std::uint32_t high = sides.front().high;
    const auto owner = [&](std::size_t i) { return sides[i].number / 3; };
    if (sides.size() == 1) note(found_.open_edges, {owner(0)}, {low, high});
    if (sides.size() > 2) note(found_.crowded_edges, {owner(0), owner(1), owner(2)}, {low, high});
    if (sides.size() == 2 && vertex(sides[0].number) == vertex(sides[1].number))
      note(found_.flipped_edges, {owner(0), owner(1)}, {low, high});
    const auto forward =
        std::ranges::count_if(sides, [&](const Side& side) { return vertex(side.number) == low; });
    if (2 * static_cast<std::size_t>(forward) != sides.size()) found_.balanced = false;
    if (sides.size() > 1) count_duplicates(sides);
  }

  /// Duplicates share all three edges; they are counted at the one opposite their last vertex.
  void count_duplicates(std::span<const Side> sides) {
    std::vector<std::pair<std::uint32_t, std::uint32_t>>& apexes = scratch_;
    apexes.clear();
    for (const Side& side : sides) {
      const std::uint32_t apex = vertex(next(next(side.number)));
      if (apex > side.high) apexes.emplace_back(apex, side.number / 3);
    }
    std::sort(apexes.begin(), apexes.end());
    for (std::size_t i = 1; i < apexes.size(); ++i)
      if (apexes[i].first == apexes[i - 1].first)
        note(found_.duplicates, {apexes[i - 1].second, apexes[i].second}, {});
  }

  /// Two triangles with a common edge belong to one shell, and to one fan at each of its ends.
  void join(std::uint32_t a, std::uint32_t b) {
    shells_.unite(a / 3, b / 3);
    const bool same_way = vertex(a) == vertex(b);
    fans_.unite(a, same_way ? b : next(b));
    fans_.unite(next(a), same_way ? next(b) : b);
  }

  void count_split_vertices() {
    constexpr std::uint32_t kNone = UINT32_MAX;
    std::vector<std::uint32_t> fan_of(points_, kNone);
    std::vector<bool> counted(points_, false);
    for (std::uint32_t corner = 0; corner < 3 * triangles_.size(); ++corner) {
      step_of_loop();
      if (collapsed(triangles_[corner / 3]) || fans_.of(corner) != corner) continue;
      const std::uint32_t v = vertex(corner);
      if (fan_of[v] == kNone) {
        fan_of[v] = corner;
      } else if (!counted[v]) {
        counted[v] = true;
        note(found_.split_vertices, {fan_of[v] / 3, corner / 3}, {v});
      }
    }
  }

  void count_components() {
    for (std::uint32_t t = 0; t < triangles_.size(); ++t)
      if (!collapsed(triangles_[t]) && shells_.of(t) == t) ++found_.components;
    if (found_.components < 2) return;
    found_.component_of.resize(triangles_.size());
    for (std::uint32_t t = 0; t < triangles_.size(); ++t) found_.component_of[t] = shells_.of(t);
  }

  std::size_t points_;
  std::span<const Triangle> triangles_;
  DisjointSets fans_;    ///< of corners
  DisjointSets shells_;  ///< of triangles
  std::vector<std::pair<std::uint32_t, std::uint32_t>> scratch_;
  MeshTopology found_;
};

}  // namespace

void note(Fault& fault, std::initializer_list<std::uint32_t> triangles,
          std::initializer_list<std::uint32_t> vertices) {
  if (fault.count++ > 0) return;
  fault.triangles = triangles;
  fault.vertices = vertices;
}

Fault indices_out_of_range(std::size_t points, std::span<const Triangle> triangles) {
  Fault fault;
  for (std::size_t t = 0; t < triangles.size(); ++t)
    if (*std::max_element(triangles[t].begin(), triangles[t].end()) >= points)
      note(fault, {narrow(t)}, {});
  return fault;
}

MeshTopology topology_of(std::size_t points, std::span<const Triangle> triangles) {
  return TopologyCount(points, triangles).run();
}

void drop_unused_points(TriangleMesh& mesh) {
  std::vector<bool> used(mesh.points.size(), false);
  for (const Triangle& t : mesh.triangles)
    for (const std::uint32_t v : t) used[v] = true;
  std::vector<std::uint32_t> number(mesh.points.size(), 0);
  std::size_t kept = 0;
  for (std::size_t v = 0; v < mesh.points.size(); ++v) {
    if (!used[v]) continue;
    number[v] = static_cast<std::uint32_t>(kept);
    mesh.points[kept++] = mesh.points[v];
  }
  mesh.points.resize(kept);
  for (Triangle& t : mesh.triangles)
    for (std::uint32_t& v : t) v = number[v];
}

}  // namespace clay::solid
