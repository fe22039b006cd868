#pragma once
#include "claystack/export/section.hpp"

#include <cstddef>
#include <vector>

namespace clay::solid::inline section {

struct LineEdge {
  ProfilePoint from, to;
};

/// A line of a section in a tree of boxes, in the order of the line, for proximity queries. Edges
/// along the axis make no surface and are left out.
class LineTree {
 public:
  explicit LineTree(const Polygon& line);

  /// Squared distance [mm^2] of the nearest edge to `edge`, or `bound2` if none is nearer. 0 if
  /// they intersect.
  [[nodiscard]] double nearest2(const LineEdge& edge, double bound2) const;

  /// The same for the nearest pair of edges, one of each line.
  [[nodiscard]] double nearest2(const LineTree& other, double bound2) const;

  /// Whether there is such an edge, or pair; ends at the first that is found.
  [[nodiscard]] bool any_nearer2(const LineEdge& edge, double bound2) const;
  [[nodiscard]] bool any_nearer2(const LineTree& other, double bound2) const;

 private:
  struct Search {
    double least2;         ///< so far
    double enough2 = 0.0;  ///< ends below this

    [[nodiscard]] bool done() const noexcept { return least2 < enough2; }
  };
  struct Box {
    double rho_low, rho_high, y_low, y_high;
  };
  struct Node {
    std::size_t level, index;
  };

  static double distance2(const Box& a, const Box& b);
  static Box box_of(const LineEdge& edge);
  static Box around(const Box& a, const Box& b);

  [[nodiscard]] const Box& box(Node node) const { return levels_[node.level][node.index]; }
  [[nodiscard]] double run(const LineEdge& edge, Search search) const;
  [[nodiscard]] double run(const LineTree& other, Search search) const;
  void descend(Node node, const Box& box, const LineEdge& edge, Search& search) const;
  void descend(Node node, const LineTree& other, Node across, Search& search) const;
  template <class Visit>
  void for_each_edge(Node leaf, Visit visit) const;
  template <class Visit>
  void for_each_child(Node node, Visit visit) const;

  std::vector<LineEdge> edges_;
  std::vector<std::vector<Box>> levels_;  ///< [0] are the leaves, the last is the root
};

}  // namespace clay::solid::inline section
