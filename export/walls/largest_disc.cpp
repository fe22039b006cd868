#include "export/walls/largest_disc.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <queue>
#include <vector>

namespace clay::solid::inline walls {
namespace {

constexpr double kSizeRounding = 1e-13;  // of the size of the profile
constexpr double kUnlimited = std::numeric_limits<double>::infinity();

/// The point of an edge nearest to `at`.
Vec2 nearest_on(const Edge& edge, const Vec2& at) {
  const Vec2 along = edge.to - edge.from;
  const double place = glm::dot(at - edge.from, along) / glm::dot(along, along);
  return edge.from + std::clamp(place, 0.0, 1.0) * along;
}

/// The edge nearest to a point; with `toward`, of those whose nearest point lies in that direction.
class NearestEdge {
 public:
  NearestEdge(const EdgeTree& tree, const Vec2& at, const Vec2& toward = Vec2{0.0})
      : tree_(tree), at_(at), toward_(toward), any_(toward == Vec2{0.0}) {
    EdgeNode place;
    place.centre = at;
    search_from(tree, place, *this);
  }

  [[nodiscard]] double bound(const EdgeNode& place, const EdgeNode& node) const {
    return least_distance(place, node);
  }
  [[nodiscard]] double best() const { return distance_; }
  [[nodiscard]] const Vec2& point() const { return point_; }
  [[nodiscard]] const Edge& edge() const { return edge_; }
  void leaves(const EdgeNode&, const EdgeNode& leaf) {
    for (std::uint32_t i = leaf.first; i < leaf.end; ++i) {
      const Edge edge = tree_.edge(i, leaf.first_piece);
      if (edge.on_axis()) continue;
      const Vec2 point = nearest_on(edge, at_);
      const double distance = glm::length(point - at_);
      if (distance < distance_ && (any_ || glm::dot(point - at_, toward_) > 0.0))
        distance_ = distance, point_ = point, edge_ = edge;
    }
  }

 private:
  const EdgeTree& tree_;
  Vec2 at_, toward_, point_{0.0};
  bool any_;
  Edge edge_;
  double distance_ = kUnlimited;
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
    rounding_ = kSizeRounding * glm::length(all.centre + reach);
    add(all.centre, std::max(reach.x, reach.y));
    while (!open_.empty() && open_.top().most > enough()) {
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
    const Vec2 at{std::abs(centre.x), centre.y};
    const NearestEdge nearest(tree_, at);
    const double radius = in_clay(tree_, at) ? nearest.best() : -nearest.best();
    if (radius > best_.radius) best_ = {at, nearest.point(), radius};
    double most = radius + half * std::numbers::sqrt2;
    if (radius > 0.0 && most > enough()) most = std::min(most, between(at, half, nearest));
    if (most > enough()) open_.push({centre, half, most});
  }

  [[nodiscard]] double enough() const { return best_.radius * (1.0 + kDiscTolerance) + rounding_; }

  /// Upper bound of the radius for centres in a square. A disc reaches no further than to the
  /// nearest edge and to the nearest one on the other side. Both distances are convex, so their
  /// mean is greatest at a corner. In clay of even thickness it is the same everywhere.
  double between(const Vec2& at, double half, const NearestEdge& nearest) const {
    const Vec2 toward = at - nearest.point();
    const NearestEdge other(tree_, at, toward), image(tree_, mirrored(at), mirrored(toward));
    const bool across = image.best() < other.best();
    if (!std::isfinite(std::min(image.best(), other.best()))) return kUnlimited;
    Edge opposite = across ? image.edge() : other.edge();
    if (across) opposite.from = mirrored(opposite.from), opposite.to = mirrored(opposite.to);
    double most = 0.0;
    for (const Vec2 corner : {Vec2{-1, -1}, Vec2{-1, 1}, Vec2{1, -1}, Vec2{1, 1}}) {
      const Vec2 c = at + half * corner;
      most = std::max(most, 0.5 * (glm::length(nearest_on(nearest.edge(), c) - c) +
                                   glm::length(nearest_on(opposite, c) - c)));
    }
    return most;
  }

  const EdgeTree& tree_;
  double rounding_ = 0.0;  ///< [mm]
  Disc best_;
  std::priority_queue<Square> open_;
};

}  // namespace

Disc largest_disc(const EdgeTree& tree) { return DiscSearch(tree).run(); }

}  // namespace clay::solid::inline walls
