#pragma once
// Boxes over the edges of a profile, for branch-and-bound searches. Neighbours along a polygon are
// neighbours in space, so runs of edges, halved repeatedly, form the tree.

#include "claystack/export/section.hpp"

#include "core/cancel.hpp"

#include <cstddef>
#include <cstdint>
#include <glm/geometric.hpp>
#include <glm/vec2.hpp>
#include <utility>
#include <vector>

namespace clay::solid::inline walls {

using Vec2 = glm::dvec2;  ///< (rho, y) [mm]

inline double cross(const Vec2& a, const Vec2& b) { return a.x * b.y - a.y * b.x; }
inline Vec2 mirrored(const Vec2& v) { return {-v.x, v.y}; }

struct Edge {
  Vec2 from{0.0}, to{0.0};
  Vec2 inward{0.0};  ///< unit normal, into the clay
  std::uint32_t index = 0;
  [[nodiscard]] bool on_axis() const { return from.x == 0.0 && to.x == 0.0; }
};

/// A run of edges of one or more pieces, in a rectangle of any orientation.
struct EdgeNode {
  Vec2 centre{0.0}, along{1.0, 0.0};  ///< of the rectangle; `along` is its unit direction
  double half_length = 0.0, half_width = 0.0;
  /// Inward normals, including those between two edges at a reentrant corner, differ from this
  /// direction [rad] by at most `normal_spread`, which is negative if there are none.
  double normal_angle = 0.0, normal_spread = -1.0;
  double arc_begin = 0.0, arc_end = 0.0;  ///< along the polygon [mm], see `EdgeTree::perimeter`
  std::uint32_t first = 0, end = 0;       ///< edges
  std::uint32_t first_piece = 0, last_piece = 0;
  std::uint32_t leaves = 1;
};

/// Lower bound of the distance between any edge of one and any edge of the other.
[[nodiscard]] double least_distance(const EdgeNode& a, const EdgeNode& b) noexcept;

/// Upper bound of the angle between any inward normal of one and any of the other [rad]; negative
/// without normals.
[[nodiscard]] double greatest_turn(const EdgeNode& a, const EdgeNode& b) noexcept;

class EdgeTree {
 public:
  static constexpr std::size_t kLeafEdges = 8;

  /// Requires at least one edge. Every rho is multiplied by `rho_scale`; arc lengths are those of
  /// the profile with every rho multiplied by `arc_scale`.
  EdgeTree(const Profile& profile, double rho_scale, double arc_scale);
  EdgeTree(const Profile& profile, double rho_scale) : EdgeTree(profile, rho_scale, rho_scale) {}

  [[nodiscard]] const std::vector<EdgeNode>& nodes() const { return nodes_; }
  /// Requires a node of two or more leaves. The root is node 0.
  [[nodiscard]] static std::size_t left(std::size_t node) { return node + 1; }
  [[nodiscard]] std::size_t right(std::size_t node) const {
    return node + 2 * left_leaves(nodes_[node].leaves);
  }

  [[nodiscard]] std::size_t edge_count() const { return points_.size(); }
  /// Edge `index` of `piece`: from the vertex of that index to the next.
  [[nodiscard]] Edge edge(std::uint32_t index, std::uint32_t piece) const;
  [[nodiscard]] std::uint32_t before(std::uint32_t index, std::uint32_t piece) const {
    return (index > begins_[piece] ? index : begins_[piece + 1]) - 1;
  }
  [[nodiscard]] std::uint32_t after(std::uint32_t index, std::uint32_t piece) const {
    return index + 1 < begins_[piece + 1] ? index + 1 : begins_[piece];
  }
  [[nodiscard]] std::uint32_t first_edge(std::uint32_t piece) const { return begins_[piece]; }
  [[nodiscard]] std::uint32_t piece_count() const {
    return static_cast<std::uint32_t>(begins_.size() - 1);
  }
  [[nodiscard]] const Vec2& point(std::uint32_t index) const { return points_[index]; }

  /// Arc length of a whole polygon [mm]. Edges on the axis are no surface: in arc length they count
  /// as longer than all others together.
  [[nodiscard]] double perimeter(std::uint32_t piece) const { return perimeters_[piece]; }
  [[nodiscard]] double arc_length(const Edge& edge) const {
    const Vec2 along = edge.to - edge.from;
    return edge.on_axis() ? axis_arc_ : glm::length(Vec2{along.x * arc_per_rho_, along.y});
  }
  [[nodiscard]] double axis_arc() const { return axis_arc_; }

 private:
  static std::size_t left_leaves(std::size_t leaves) { return (leaves + 1) / 2; }
  void make_leaves(std::vector<EdgeNode>& leaves);
  [[nodiscard]] EdgeNode leaf(std::uint32_t first, std::uint32_t end, std::uint32_t piece,
                              double arc) const;
  void add_node(const std::vector<EdgeNode>& leaves, std::size_t first, std::size_t end);
  [[nodiscard]] EdgeNode joined(const EdgeNode& a, const EdgeNode& b) const;

  std::vector<Vec2> points_;           ///< of all pieces
  std::vector<std::uint32_t> begins_;  ///< first point of each piece, and their number
  std::vector<double> perimeters_;
  double axis_arc_ = 0.0, arc_per_rho_ = 1.0;
  std::vector<EdgeNode> nodes_;  ///< preorder: node, left half, right half
};

/// Descends towards the part nearest to `node`. `search.bound(a, b)` is a lower bound for any edges
/// of the two; `search.best()` the best known; `search.leaves(a, b)` compares.
template <class Search>
void search_from(const EdgeTree& tree, const EdgeNode& node, Search& search, std::size_t at = 0,
                 double bound = 0.0) {
  step_of_loop();
  if (bound >= search.best()) return;
  const EdgeNode& here = tree.nodes()[at];
  if (here.leaves == 1) return search.leaves(node, here);
  std::size_t near = EdgeTree::left(at), far = tree.right(at);
  double near_bound = search.bound(node, tree.nodes()[near]);
  double far_bound = search.bound(node, tree.nodes()[far]);
  if (far_bound < near_bound) std::swap(near, far), std::swap(near_bound, far_bound);
  search_from(tree, node, search, near, near_bound);
  search_from(tree, node, search, far, far_bound);
}

/// The same for all pairs of edges below nodes `a` and `b`, a <= b, each pair once.
template <class Search>
void search_pairs(const EdgeTree& tree, Search& search, std::size_t a = 0, std::size_t b = 0,
                  double bound = 0.0) {
  step_of_loop();
  if (bound >= search.best()) return;
  const EdgeNode &first = tree.nodes()[a], &second = tree.nodes()[b];
  if (first.leaves == 1 && second.leaves == 1) return search.leaves(first, second);
  const auto below = [&](std::size_t i, std::size_t j) {
    return search.bound(tree.nodes()[i], tree.nodes()[j]);
  };
  if (a == b) {
    const std::size_t left = EdgeTree::left(a), right = tree.right(a);
    // The rising half of a polygon against the falling half: nearest first.
    search_pairs(tree, search, left, right, below(left, right));
    search_pairs(tree, search, left, left, below(left, left));
    search_pairs(tree, search, right, right, below(right, right));
    return;
  }
  const bool split_first =
      second.leaves == 1 || (first.leaves > 1 && first.half_length > second.half_length);
  const std::size_t split = split_first ? a : b;
  const auto go = [&](std::size_t part, double at_least) {
    split_first ? search_pairs(tree, search, part, b, at_least)
                : search_pairs(tree, search, a, part, at_least);
  };
  std::size_t near = EdgeTree::left(split), far = tree.right(split);
  double near_bound = split_first ? below(near, b) : below(a, near);
  double far_bound = split_first ? below(far, b) : below(a, far);
  if (far_bound < near_bound) std::swap(near, far), std::swap(near_bound, far_bound);
  go(near, near_bound);
  go(far, far_bound);
}

}  // namespace clay::solid::inline walls
