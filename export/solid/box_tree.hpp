#pragma once
// Bounds of the triangles of a mesh, of halves of them, and halves of those: for rays.

#include "claystack/export/solid.hpp"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <glm/vec3.hpp>
#include <limits>
#include <span>
#include <vector>

namespace clay::solid {

/// About 40 bytes a triangle, and 16 more while it is built. For queries from many threads.
class BoxTree {
 public:
  /// A box, and the part of it between two parallel planes. These lie along the triangles: where
  /// many lean the same way, one behind the other, boxes alone say nothing. All a little larger
  /// than what is between them, so that rounding in a test does no harm.
  struct Box {
    glm::dvec3 low{std::numeric_limits<double>::infinity()};
    glm::dvec3 high{-std::numeric_limits<double>::infinity()};
    glm::vec3 across{0.0F};  ///< from plane to plane; about a unit long, or 0 where there are none
    double from = 0.0, to = 0.0;  ///< of a point's product with `across`
  };
  static constexpr double kNever = std::numeric_limits<double>::infinity();

  /// The mesh outlives this; it has a triangle, points are finite, indices in range.
  explicit BoxTree(const TriangleMesh& mesh);

  /// visit(triangles) for the leaves in reach, the nearest first. `entry(box)` says how far
  /// away a box begins, or kNever. What begins beyond `limit()`, which is asked again and again,
  /// is left out.
  template <class Entry, class Limit, class Visit>
  void for_each_near(const Entry& entry, const Limit& limit, const Visit& visit) const;

 private:
  static constexpr std::size_t kLeaf = 6;  ///< triangles at most

  struct Node {
    Box box;
    std::uint32_t second = 0;  ///< half; the first one follows its parent
  };
  /// A node with the triangles in it.
  struct Part {
    std::uint32_t node, begin, end;
    double entry;
  };

  std::uint32_t build(std::vector<glm::vec3>& middles, std::uint32_t begin, std::uint32_t end);
  [[nodiscard]] Box box_of(std::uint32_t begin, std::uint32_t end) const;
  void set_planes(Box& box, std::uint32_t begin, std::uint32_t end) const;

  const TriangleMesh& mesh_;
  double margin_ = 0.0;
  std::vector<std::uint32_t> order_;  ///< of the triangles
  std::vector<Node> nodes_;
};

template <class Entry, class Limit, class Visit>
void BoxTree::for_each_near(const Entry& entry, const Limit& limit, const Visit& visit) const {
  std::vector<Part> open;  // a heap, the nearest on top
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
