#include "export/repair/touching_parts.hpp"

#include "core/cancel.hpp"
#include "export/formats/file_floats.hpp"
#include "export/proof/pair_test.hpp"
#include "export/solid/disjoint_sets.hpp"

#include <algorithm>
#include <glm/geometric.hpp>
#include <map>
#include <numeric>
#include <span>
#include <tuple>
#include <vector>

namespace clay::solid::inline repair {
namespace {

/// A triangle at an edge, and the corner where it follows the edge.
struct FanWing {
  std::uint32_t low, high, triangle;
  std::uint32_t corner;  ///< of the start of the edge
  bool rising;           ///< from low to high
};

std::uint32_t node(std::uint32_t triangle, std::uint32_t corner) { return 3 * triangle + corner; }

class Fans {
 public:
  explicit Fans(TriangleMesh& mesh) : mesh_(mesh), fans_(3 * mesh.triangles.size()) { join(); }

  /// Edges of several pairs of triangles that lie in the same fans at both ends get a new vertex in
  /// the middle. Returns true if there were any.
  bool split_stuck_edges() {
    std::map<std::uint32_t, std::vector<std::pair<FanWing, std::uint32_t>>> cuts;  // by triangle
    for (const std::vector<FanWing>& wings : crowded_) {
      std::vector<std::pair<std::uint32_t, std::uint32_t>> ends;
      for (std::size_t i = 0; i < wings.size(); i += 2)
        ends.push_back({fan_at(wings[i], true), fan_at(wings[i], false)});
      std::sort(ends.begin(), ends.end());
      if (std::adjacent_find(ends.begin(), ends.end()) == ends.end()) continue;
      const glm::dvec3 middle = 0.5 * (mesh_.points[wings[0].low] + mesh_.points[wings[0].high]);
      mesh_.points.emplace_back(file_point(middle));
      for (const FanWing& wing : wings)
        cuts[wing.triangle].emplace_back(wing, static_cast<std::uint32_t>(mesh_.points.size() - 1));
    }
    // One edge of each triangle at a time; the others follow in the next round.
    std::vector<bool> done(mesh_.points.size(), false), refused(mesh_.points.size(), false);
    for (const auto& [t, of_triangle] : cuts)
      for (std::size_t i = 1; i < of_triangle.size(); ++i) refused[of_triangle[i].second] = true;
    bool any = false;
    for (const auto& [t, of_triangle] : cuts) {
      const auto& [wing, middle] = of_triangle.front();
      if (refused[middle]) continue;
      const Triangle old = mesh_.triangles[t];
      const std::size_t c = wing.corner;
      mesh_.triangles[t] = {old.at(c), middle, old.at((c + 2) % 3)};
      mesh_.triangles.push_back({middle, old.at((c + 1) % 3), old.at((c + 2) % 3)});
      any = true;
    }
    return any;
  }

  std::size_t separate(double gap_mm) {
    std::map<std::uint32_t, std::vector<std::uint32_t>> fans;  // by vertex
    std::vector<bool> several(mesh_.points.size(), false);
    std::vector<std::uint32_t> first(mesh_.points.size(), UINT32_MAX);
    for_each_corner([&](std::uint32_t v, std::uint32_t at) {
      const std::uint32_t fan = fans_.of(at);
      if (first[v] == UINT32_MAX) first[v] = fan;
      if (first[v] != fan) several[v] = true;
    });
    std::map<std::uint32_t, std::vector<std::uint32_t>> corners;  // by fan
    for_each_corner([&](std::uint32_t v, std::uint32_t at) {
      if (!several[v]) return;
      const std::uint32_t fan = fans_.of(at);
      if (corners[fan].empty()) fans[v].push_back(fan);
      corners[fan].push_back(at);
    });
    std::size_t moved = 0;
    for (const auto& [v, of_vertex] : fans) {
      std::vector<std::pair<double, std::uint32_t>> ranked;
      for (const std::uint32_t fan : of_vertex)
        ranked.emplace_back(glm::length(towards_ring(v, corners[fan])), fan);
      std::sort(ranked.begin(), ranked.end());
      for (std::size_t i = 1; i < ranked.size(); ++i)
        move(v, corners[ranked[i].second], gap_mm * static_cast<double>(i));
      moved += ranked.size() - 1;
    }
    return moved;
  }

 private:
  template <class Visit>
  void for_each_corner(const Visit& visit) {
    for (std::uint32_t t = 0; t < mesh_.triangles.size(); ++t)
      for (std::uint32_t c = 0; c < 3; ++c) visit(mesh_.triangles[t].at(c), node(t, c));
  }

  /// Joins the corners of triangles that are neighbours in the surface of one part.
  void join() {
    std::vector<FanWing> wings;
    wings.reserve(3 * mesh_.triangles.size());
    for (std::uint32_t t = 0; t < mesh_.triangles.size(); ++t)
      for (std::uint32_t c = 0; c < 3; ++c) {
        const std::uint32_t a = mesh_.triangles[t].at(c), b = mesh_.triangles[t].at((c + 1) % 3);
        wings.push_back({std::min(a, b), std::max(a, b), t, c, a < b});
      }
    std::sort(wings.begin(), wings.end(), [](const FanWing& a, const FanWing& b) {
      return std::tie(a.low, a.high, a.triangle) < std::tie(b.low, b.high, b.triangle);
    });
    for (std::size_t begin = 0; begin < wings.size();) {
      step_of_loop();
      std::size_t end = begin + 1;
      while (end < wings.size() && wings[end].low == wings[begin].low &&
             wings[end].high == wings[begin].high)
        ++end;
      join_about(std::span(wings).subspan(begin, end - begin));
      begin = end;
    }
  }

  void join_about(std::span<FanWing> wings) {
    if (wings.size() == 2) return join_pair(wings[0], wings[1]);
    if (wings.size() < 2 || wings.size() % 2 != 0) return;
    sort_around(wings);
    // The clay lies counterclockwise of a triangle that falls.
    const auto first =
        std::find_if(wings.begin(), wings.end(), [](const FanWing& w) { return !w.rising; });
    std::rotate(wings.begin(), first, wings.end());
    for (std::size_t i = 0; i < wings.size(); i += 2) join_pair(wings[i], wings[i + 1]);
    crowded_.emplace_back(wings.begin(), wings.end());
  }

  void join_pair(const FanWing& a, const FanWing& b) {
    fans_.unite(corner_at(a, true), corner_at(b, true));
    fans_.unite(corner_at(a, false), corner_at(b, false));
  }

  static std::uint32_t corner_at(const FanWing& wing, bool low) {
    return node(wing.triangle, low == wing.rising ? wing.corner : (wing.corner + 1) % 3);
  }
  std::uint32_t fan_at(const FanWing& wing, bool low) { return fans_.of(corner_at(wing, low)); }

  [[nodiscard]] std::uint32_t apex(const FanWing& wing) const {
    return mesh_.triangles[wing.triangle].at((wing.corner + 2) % 3);
  }

  /// Rounding may have left triangles without area: they count as opposite to the first with area.
  void sort_around(std::span<FanWing> wings) const {
    const PairTest test(mesh_);
    const auto flat = [&](const FanWing& wing) {
      return test.degenerate(mesh_.triangles[wing.triangle]);
    };
    const auto wide = std::find_if_not(wings.begin(), wings.end(), flat);
    if (wide == wings.end()) return;
    const FanWing first = *wide;
    const auto quarter = [&](const FanWing& from, const FanWing& to) {
      if (from.triangle == to.triangle) return 0;
      if (flat(from) || flat(to)) return 2;
      return test.quarter(first.low, first.high, apex(from), apex(to));
    };
    std::sort(wings.begin(), wings.end(), [&](const FanWing& a, const FanWing& b) {
      const int at_a = quarter(first, a), at_b = quarter(first, b);
      return at_a != at_b ? at_a < at_b : quarter(a, b) == 1;
    });
  }

  /// From the vertex to the middle of its neighbours in the fan.
  [[nodiscard]] glm::dvec3 towards_ring(std::uint32_t v,
                                        const std::vector<std::uint32_t>& corners) const {
    glm::dvec3 sum(0.0);
    for (const std::uint32_t at : corners)
      for (const std::uint32_t step : {1U, 2U})
        sum += mesh_.points[mesh_.triangles[at / 3].at((at % 3 + step) % 3)] - mesh_.points[v];
    return sum / (2.0 * static_cast<double>(corners.size()));
  }

  [[nodiscard]] glm::dvec3 into_clay(const std::vector<std::uint32_t>& corners) const {
    glm::dvec3 sum(0.0);
    for (const std::uint32_t at : corners) {
      const auto& [a, b, c] = mesh_.triangles[at / 3];
      sum -= glm::cross(mesh_.points[b] - mesh_.points[a], mesh_.points[c] - mesh_.points[a]);
    }
    return sum;
  }

  void move(std::uint32_t v, const std::vector<std::uint32_t>& corners, double gap_mm) {
    glm::dvec3 way = towards_ring(v, corners);
    double length = glm::length(way), step = std::min(gap_mm, 0.25 * length);
    if (length < gap_mm) {
      way = into_clay(corners);
      length = glm::length(way);
      step = gap_mm;
    }
    if (length > 0.0) way *= step / length;
    const auto copy = static_cast<std::uint32_t>(mesh_.points.size());
    mesh_.points.emplace_back(file_point(mesh_.points[v] + way));
    for (const std::uint32_t at : corners) mesh_.triangles[at / 3].at(at % 3) = copy;
  }

  TriangleMesh& mesh_;
  DisjointSets fans_;
  std::vector<std::vector<FanWing>>
      crowded_;  ///< paired: two that bound the same clay follow each other
};

}  // namespace

std::size_t pull_apart(TriangleMesh& mesh, double gap_mm) {
  constexpr int kMostSplits = 4;
  for (int split = 0; split < kMostSplits; ++split)
    if (!Fans(mesh).split_stuck_edges()) break;
  return Fans(mesh).separate(gap_mm);
}

}  // namespace clay::solid::inline repair
