#pragma once
// Thickness between two edges: the smallest ball that touches both faces.

#include "export/walls/edge_tree.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <utility>
#include <vector>

namespace clay::solid::inline walls {

struct Ball {
  double diameter = std::numeric_limits<double>::infinity();
  Vec2 from{0.0}, to{0.0};  ///< points of contact
  bool at_corner = false;   ///< a reentrant corner at either end
};

/// A corner where the clay fills more than a half-plane: a ball may touch it from every direction
/// between the normals of its two edges.
struct ReentrantCorner {
  Vec2 at{0.0};
  Vec2 before{0.0}, after{0.0};  ///< inward normals
  [[nodiscard]] bool faces(const Vec2& way) const {
    return cross(before, way) <= 0.0 && cross(after, way) >= 0.0 &&
           glm::dot(before + after, way) > 0.0;
  }
};

/// Balls between two faces, each minimal for its kind of contact.
class Balls {
 public:
  /// Keeps only balls smaller than `limit`.
  explicit Balls(double limit) : limit_(limit) {}
  void keep(const Ball& ball) {
    if (ball.diameter >= limit_) return;
    balls_[count_] = ball;
    if (swapped_) std::swap(balls_[count_].from, balls_[count_].to);
    ++count_;
  }
  /// From now on the faces are given in reverse order.
  void swap() { swapped_ = !swapped_; }
  [[nodiscard]] const Ball* begin() const { return balls_.data(); }
  [[nodiscard]] const Ball* end() const { return balls_.data() + count_; }

 private:
  /// Eight between the edges; for each of two corners, twice, one edge and two corners.
  std::array<Ball, 20> balls_;
  std::size_t count_ = 0;
  double limit_;
  bool swapped_ = false;
};

/// An edge off the axis and its place along the polygon.
struct Face {
  Edge edge;
  double arc_begin = 0.0, arc_end = 0.0;
  std::uint32_t piece = 0;
  /// Whether the edge begins with a reentrant corner or, at the axis, ends with one.
  bool begins_reentrant = false, ends_reentrant = false;
  Vec2 before{0.0};  ///< inward normal of the previous edge; on the axis, of the mirror image

  [[nodiscard]] bool has_corners() const { return begins_reentrant || ends_reentrant; }
  template <class Visit>
  void each_corner(Visit visit) const {
    if (begins_reentrant) visit(ReentrantCorner{edge.from, before, edge.inward});
    if (ends_reentrant) visit(ReentrantCorner{edge.to, edge.inward, mirrored(edge.inward)});
  }
};

/// The faces of a leaf of the tree.
class LeafFaces {
 public:
  LeafFaces(const EdgeTree& tree, const EdgeNode& leaf);
  [[nodiscard]] const Face* begin() const { return faces_.data(); }
  [[nodiscard]] const Face* end() const { return faces_.data() + count_; }

 private:
  std::array<Face, EdgeTree::kLeafEdges> faces_;
  std::size_t count_ = 0;
};

/// Faces are opposite if the angle between their inward normals exceeds this [rad].
inline constexpr double kOpposite = 150.0 / 180.0 * std::numbers::pi;
inline const double kMinusCosOpposite = -std::cos(kOpposite);
[[nodiscard]] inline bool opposite(const Vec2& normal, const Vec2& other) {
  return glm::dot(normal, other) < -kMinusCosOpposite;
}

/// Lower bound of the distance between the two.
[[nodiscard]] inline double least_distance(const Edge& a, const Edge& b) {
  const auto gap = [](const Edge& line, const Edge& other) {
    const double from = glm::dot(other.from - line.from, line.inward);
    const double to = glm::dot(other.to - line.from, line.inward);
    return from * to > 0.0 ? std::min(std::abs(from), std::abs(to)) : 0.0;
  };
  return std::max(gap(a, b), gap(b, a));
}

/// The minimum length of the boundary on the shorter way between two places, and a little beyond,
/// as a multiple of the thickness between them. Half a circle has pi / 2, the chords around it
/// slightly less.
inline constexpr double kRidge = 1.5;

/// Whether the clay between `ball.from` on `a` and `ball.to` on `b` is more than a ridge. Beyond
/// these points edges count as far as both continue, up to half the thickness, so that a lip is as
/// thin as its end; at a reentrant corner an edge does not continue.
[[nodiscard]] bool is_wall(const Face& a, const Face& b, const Ball& ball, double perimeter);

/// The smallest balls between two faces of one piece, by the definition of `min_wall`, including
/// ridges.
[[nodiscard]] Balls balls_between(const Face& a, const Face& b, double limit);

/// The smallest ball that touches `a` at `p` and passes through `b`; empty if there is none.
[[nodiscard]] Ball ball_at(const Vec2& p, const Face& a, const Face& b);

/// The parts of a piece on the axis.
class AxisClay {
 public:
  AxisClay(const EdgeTree& tree, std::uint32_t piece);
  /// The smallest ball centred on the axis, in clay, that touches the face.
  [[nodiscard]] Ball least_ball(const Face& face) const;
  /// The ball centred on the axis that touches the face at `p`.
  [[nodiscard]] Ball ball_at(const Vec2& p, const Face& face) const;
  /// Lower bound of the diameter of any such ball for a node's faces.
  [[nodiscard]] double bound(const EdgeNode& node) const;

 private:
  struct Stretch {
    double low = 0.0, high = 0.0;
  };
  std::vector<Stretch> stretches_;  ///< from the bottom up
};

}  // namespace clay::solid::inline walls
