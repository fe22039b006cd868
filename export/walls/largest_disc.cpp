#include "export/walls/largest_disc.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <queue>
#include <vector>

namespace clay::solid::inline walls {
namespace {

/// The boundary's point nearest to a point.
class NearestPoint {
 public:
  NearestPoint(const EdgeTree& tree, const Vec2& at) : tree_(tree), at_(at) {}

  [[nodiscard]] double bound(const EdgeNode& place, const EdgeNode& node) const {
    return least_distance(place, node);
  }
  [[nodiscard]] double best() const { return distance_; }
  [[nodiscard]] const Vec2& point() const { return point_; }
  void leaves(const EdgeNode&, const EdgeNode& leaf) {
    for (std::uint32_t i = leaf.first; i < leaf.end; ++i) {
      const Edge edge = tree_.edge(i, leaf.first_piece);
      if (edge.on_axis()) continue;
      const Vec2 along = edge.to - edge.from;
      const double place = glm::dot(at_ - edge.from, along) / glm::dot(along, along);
      const Vec2 point = edge.from + std::clamp(place, 0.0, 1.0) * along;
      const double distance = glm::length(point - at_);
      if (distance < distance_) distance_ = distance, point_ = point;
    }
  }

 private:
  const EdgeTree& tree_;
  Vec2 at_, point_{0.0};
  double distance_ = std::numeric_limits<double>::infinity();
};

/// Whether a ray from the point outwards crosses the boundary an odd number of times.
bool in_clay(const EdgeTree& tree, const Vec2& at, std::size_t index = 0) {
  const EdgeNode& node = tree.nodes()[index];
  const Vec2 along = glm::abs(node.along);
  const Vec2 reach = node.half_length * along + node.half_width * Vec2{along.y, along.x};
  if (std::abs(at.y - node.centre.y) > reach.y || at.x > node.centre.x + reach.x) return false;
  if (node.leaves > 1)
    return in_clay(tree, at, EdgeTree::left(index)) != in_clay(tree, at, tree.right(index));
  bool odd = false;
  for (std::uint32_t i = node.first; i < node.end; ++i) {
    const Edge edge = tree.edge(i, node.first_piece);
    if ((edge.from.y > at.y) == (edge.to.y > at.y)) continue;
    const double t = (at.y - edge.from.y) / (edge.to.y - edge.from.y);
    if (edge.from.x + t * (edge.to.x - edge.from.x) > at.x) odd = !odd;
  }
  return odd;
}

struct Square {
  Vec2 centre;
  double half = 0.0;
  double most = 0.0;  ///< upper bound of the radius of a disc whose centre is in the square
  friend bool operator<(const Square& a, const Square& b) { return a.most < b.most; }
};

class DiscSearch {
 public:
  explicit DiscSearch(const EdgeTree& tree) : tree_(tree) {}

  Disc run() {
    const EdgeNode& all = tree_.nodes().front();
    const Vec2 along = glm::abs(all.along);
    const Vec2 reach = all.half_length * along + all.half_width * Vec2{along.y, along.x};
    add(all.centre, std::max(reach.x, reach.y));
    while (!open_.empty() && open_.top().most > best_.radius * (1.0 + kDiscTolerance)) {
      step_of_loop();
      const Square square = open_.top();
      open_.pop();
      const double half = 0.5 * square.half;
      for (const Vec2 corner : {Vec2{-1, -1}, Vec2{-1, 1}, Vec2{1, -1}, Vec2{1, 1}})
        add(square.centre + half * corner, half);
    }
    return best_;
  }

 private:
  void add(const Vec2& centre, double half) {
    // On this side of the axis the mirror image is never nearer than the boundary itself.
    EdgeNode place;
    place.centre = {std::abs(centre.x), centre.y};
    NearestPoint nearest(tree_, place.centre);
    search_from(tree_, place, nearest);
    const double radius = in_clay(tree_, place.centre) ? nearest.best() : -nearest.best();
    if (radius > best_.radius) best_ = {place.centre, nearest.point(), radius};
    const double most = radius + half * std::numbers::sqrt2;
    if (most > best_.radius * (1.0 + kDiscTolerance)) open_.push({centre, half, most});
  }

  const EdgeTree& tree_;
  Disc best_;
  std::priority_queue<Square> open_;
};

}  // namespace

Disc largest_disc(const EdgeTree& tree) { return DiscSearch(tree).run(); }

}  // namespace clay::solid::inline walls
