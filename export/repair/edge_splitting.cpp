#include "export/repair/edge_splitting.hpp"

#include "export/repair/crack_welding.hpp"
#include "export/solid/box_tree.hpp"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <span>
#include <tuple>
#include <vector>

namespace clay::solid::inline repair {
namespace {

/// A vertex on the edge of a triangle that begins at the corner.
struct Split {
  std::uint32_t triangle;
  std::size_t corner;
  double at;  ///< 0 to 1 along the edge
  std::uint32_t vertex;
  friend bool operator<(const Split& a, const Split& b) {
    return std::tie(a.triangle, a.corner, a.at, a.vertex) <
           std::tie(b.triangle, b.corner, b.at, b.vertex);
  }
  [[nodiscard]] bool same_edge(const Split& other) const {
    return triangle == other.triangle && corner == other.corner;
  }
};

/// An open edge as its triangle has it.
struct Side {
  std::uint32_t triangle;
  std::size_t corner;
  glm::dvec3 from, way;
  double reach_mm;  ///< maximum distance of a vertex on it
};

class Splitting {
 public:
  Splitting(const TriangleMesh& mesh, std::optional<double> weld_mm)
      : mesh_(mesh), border_(open_border(mesh, weld_mm)), weld_given_(weld_mm.has_value()) {
    for (const SoupEdge& edge : border_.edges) add_side(edge);
  }

  std::vector<Split> run() {
    if (sides_.empty()) return {};
    // The faces instead of the edges: the planes of the tree separate faces.
    TriangleMesh faces{mesh_.points, {}};
    for (const Side& side : sides_) faces.triangles.push_back(mesh_.triangles[side.triangle]);
    const BoxTree tree(faces);
    for (std::uint32_t v = 0; v < border_.points.size(); ++v)
      if (border_.points[v]) find_sides_at(v, tree);
    std::sort(splits_.begin(), splits_.end());
    return std::move(splits_);
  }

 private:
  void add_side(const SoupEdge& edge) {
    // A hole whose missing triangle is flat also has a vertex near the edge: hole filling closes
    // it.
    constexpr double kOfLength = 1e-4, kOfHeight = 0.25;
    const Triangle& t = mesh_.triangles[edge.triangle];
    std::size_t c = 0;
    while (std::minmax(t.at(c), t.at((c + 1) % 3)) != std::minmax(edge.low, edge.high)) ++c;
    const glm::dvec3 from = mesh_.points[t.at(c)], way = mesh_.points[t.at((c + 1) % 3)] - from;
    const double length = glm::length(way);
    if (!(length > 0.0)) return;
    const double height =
        glm::length(glm::cross(way, mesh_.points[t.at((c + 2) % 3)] - from)) / length;
    const double reach =
        weld_given_ ? border_.crack_mm
                    : std::max(border_.rounding_mm, std::min(border_.crack_mm, kOfLength * length));
    // A triangle must not turn over.
    sides_.push_back({edge.triangle, c, from, way, std::min(reach, kOfHeight * height)});
    reach_mm_ = std::max(reach_mm_, sides_.back().reach_mm);
  }

  void find_sides_at(std::uint32_t v, const BoxTree& tree) {
    // No more, so that a file of long edges in one place does not grow without bound.
    constexpr std::size_t kMostSides = 8;
    step_of_loop();
    const glm::dvec3& p = mesh_.points[v];
    const std::size_t before = splits_.size();
    const auto entry = [&](const BoxTree::Box& box) {
      for (int axis = 0; axis < 3; ++axis)
        if (p[axis] < box.low[axis] - reach_mm_ || p[axis] > box.high[axis] + reach_mm_)
          return BoxTree::kNever;
      const double across = glm::dot(glm::dvec3(box.across), p);
      const bool between =
          box.to <= box.from || (across > box.from - 2.0 * reach_mm_ &&  // about unit length
                                 across < box.to + 2.0 * reach_mm_);
      return between ? 0.0 : BoxTree::kNever;
    };
    const auto limit = [&] { return splits_.size() - before < kMostSides ? 0.0 : -1.0; };
    tree.for_each_near(entry, limit, [&](std::span<const std::uint32_t> found) {
      for (const std::uint32_t i : found) add_if_on(sides_[i], v);
    });
  }

  void add_if_on(const Side& side, std::uint32_t v) {
    const Triangle& t = mesh_.triangles[side.triangle];
    if (std::find(t.begin(), t.end(), v) != t.end()) return;
    const glm::dvec3 to = mesh_.points[v] - side.from;
    const double length2 = glm::dot(side.way, side.way), at = glm::dot(to, side.way) / length2;
    const double margin = border_.crack_mm / std::sqrt(length2);
    if (at <= margin || at >= 1.0 - margin) return;
    if (glm::length(to - at * side.way) <= side.reach_mm)
      splits_.push_back({side.triangle, side.corner, at, v});
  }

  const TriangleMesh& mesh_;
  OpenBorder border_;
  bool weld_given_;
  double reach_mm_ = 0.0;  ///< the largest one
  std::vector<Side> sides_;
  std::vector<Split> splits_;
};

/// Replaces the triangle that has the edge from a to b by a fan from its third corner.
void fan_out(std::vector<Triangle>& parts, std::uint32_t a, std::uint32_t b,
             std::span<const Split> on_edge) {
  for (std::size_t i = 0; i < parts.size(); ++i)
    for (std::size_t c = 0; c < 3; ++c) {
      if (parts[i].at(c) != a || parts[i].at((c + 1) % 3) != b) continue;
      const std::uint32_t opposite = parts[i].at((c + 2) % 3);
      parts[i] = {a, on_edge.front().vertex, opposite};
      for (std::size_t k = 0; k < on_edge.size(); ++k)
        parts.push_back(
            {on_edge[k].vertex, k + 1 < on_edge.size() ? on_edge[k + 1].vertex : b, opposite});
      return;
    }
}

}  // namespace

std::size_t split_edges(TriangleMesh& mesh, std::optional<double> weld_mm) {
  const std::vector<Split> splits = Splitting(mesh, weld_mm).run();
  std::vector<Triangle> parts;
  for (auto begin = splits.begin(); begin != splits.end();) {
    const std::uint32_t triangle = begin->triangle;
    const Triangle whole = mesh.triangles[triangle];
    parts = {whole};
    while (begin != splits.end() && begin->triangle == triangle) {
      const auto end = std::find_if(begin, splits.end(),
                                    [&](const Split& split) { return !split.same_edge(*begin); });
      fan_out(parts, whole.at(begin->corner), whole.at((begin->corner + 1) % 3), {begin, end});
      begin = end;
    }
    mesh.triangles[triangle] = parts.front();
    mesh.triangles.insert(mesh.triangles.end(), parts.begin() + 1, parts.end());
  }
  return splits.size();
}

}  // namespace clay::solid::inline repair
