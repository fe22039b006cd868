#pragma once
// A bounding volume tree over the triangles of a mesh, for rays.

#include "claystack/export/solid.hpp"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <glm/vec3.hpp>
#include <limits>
#include <span>
#include <vector>

namespace clay::solid {

/// About 40 bytes per triangle, and 16 more during construction. Allows queries from many threads.
class BoxTree {
 public:
  /// A box, and the part of it between two parallel planes. The planes follow the triangles: where
  /// many triangles are inclined the same way, one behind the other, boxes alone do not separate
  /// them. All are slightly enlarged, so that rounding in a test is harmless.
  struct Box {
    glm::dvec3 low{std::numeric_limits<double>::infinity()};
    glm::dvec3 high{-std::numeric_limits<double>::infinity()};
    glm::vec3 across{0.0F};       ///< from plane to plane; about unit length, or 0 without planes
    double from = 0.0, to = 0.0;  ///< of a point's dot product with `across`
  };
  static constexpr double kNever = std::numeric_limits<double>::infinity();

  /// The mesh outlives this; it has at least one triangle, finite points, indices in range.
  explicit BoxTree(const TriangleMesh& mesh);

  /// Calls visit(triangles) for the leaves in reach, nearest first. `entry(box)` returns the
  /// distance at which a box begins, or kNever. Boxes beyond `limit()`, which is evaluated
  /// repeatedly, are skipped.
  template <class Entry, class Limit, class Visit>
  void for_each_near(const Entry& entry, const Limit& limit, const Visit& visit) const;

 private:
  static constexpr std::size_t kLeaf = 6;  ///< most triangles of a leaf

  struct Node {
    Box box;
    std::uint32_t second = 0;  ///< second child; the first child follows its parent
  };
  /// A node with its triangles.
  struct Part {
    std::uint32_t node, begin, end;
    double entry;
  };

  std::uint32_t build(std::vector<glm::vec3>& middles, std::uint32_t begin, std::uint32_t end);
  [[nodiscard]] Box box_of(std::uint32_t begin, std::uint32_t end) const;
  void set_planes(Box& box, std::uint32_t begin, std::uint32_t end) const;

  const TriangleMesh& mesh_;
  double margin_ = 0.0;
  std::vector<std::uint32_t> order_;  ///< permutation of the triangles
  std::vector<Node> nodes_;
};

template <class Entry, class Limit, class Visit>
void BoxTree::for_each_near(const Entry& entry, const Limit& limit, const Visit& visit) const {
  std::vector<Part> open;  // a heap, nearest first
  const auto farther = [](const Part& a, const Part& b) { return a.entry > b.entry; };
  const auto offer = [&](std::uint32_t node, std::uint32_t begin, std::uint32_t end) {
    const double at = entry(nodes_[node].box);
    if (!(at < kNever) || at > limit()) return;
    open.push_back({node, begin, end, at});
    std::push_heap(open.begin(), open.end(), farther);
  };
  offer(0, 0, static_cast<std::uint32_t>(order_.size()));
  while (!open.empty() && !(open.front().entry > limit())) {
    std::pop_heap(open.begin(), open.end(), farther);
    const Part part = open.back();
    open.pop_back();
    if (part.end - part.begin <= kLeaf) {
      visit(std::span(order_).subspan(part.begin, part.end - part.begin));
      continue;
    }
    const std::uint32_t middle = part.begin + (part.end - part.begin) / 2;
    offer(part.node + 1, part.begin, middle);
    offer(nodes_[part.node].second, middle, part.end);
  }
}

}  // namespace clay::solid
