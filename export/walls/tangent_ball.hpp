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
  double to_arc = -1.0;     ///< of `to`, from `PlaceSearch`; negative across the axis
  /// Diameter of the smallest ball that was met and has too little boundary, see `kSpan`.
  double excluded = std::numeric_limits<double>::infinity();
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

/// An edge off the axis and its place along the polygon.
struct Face {
  Edge edge;
  double arc_begin = 0.0, arc_end = 0.0;
  std::uint32_t piece = 0;
  /// Whether the edge begins with a reentrant corner or, at the axis, ends with one.
  bool begins_reentrant = false, ends_reentrant = false;
  Vec2 before{0.0};  ///< inward normal of the previous edge; on the axis, of the mirror image

  [[nodiscard]] bool has_corners() const { return begins_reentrant || ends_reentrant; }
  /// Calls `visit(corner, place)`.
  template <class Visit>
  void each_corner(Visit visit) const {
    if (begins_reentrant) visit(ReentrantCorner{edge.from, before, edge.inward}, 0.0);
    if (ends_reentrant) visit(ReentrantCorner{edge.to, edge.inward, mirrored(edge.inward)}, 1.0);
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

/// The inward normals of opposite faces are more than 90 degrees apart, by more than rounding: the
/// faces of a step are not opposite. That keeps the search away from neighbouring faces; `kSpan`
/// decides which clay is a wall.
inline constexpr double kTurnSlack = 1e-9;                                ///< [rad]
inline constexpr double kOpposite = std::numbers::pi / 2.0 + kTurnSlack;  ///< [rad]
[[nodiscard]] inline bool opposite(const Vec2& normal, const Vec2& other) {
  return glm::dot(normal, other) < -kTurnSlack;
}

/// False if no ball can touch both faces: then all normals of one lie within 90 degrees of all of
/// the other, as on one side of a staircase.
[[nodiscard]] inline bool may_face(const Face& a, const Face& b) {
  const auto against = [](const Face& face, const Vec2& way) {
    return glm::dot(face.edge.inward, way) < 0.0 ||
           (face.begins_reentrant && glm::dot(face.before, way) < 0.0) ||
           (face.ends_reentrant && glm::dot(mirrored(face.edge.inward), way) < 0.0);
  };
  return against(a, b.edge.inward) || (b.begins_reentrant && against(a, b.before)) ||
         (b.ends_reentrant && against(a, mirrored(b.edge.inward)));
}

/// A ball spans a wall if the boundary between its points of contact is at least this many
/// diameters long, either way round. Less is an edge, a ridge or a rounded end.
inline constexpr double kSpan = 3.0;

/// Lower bound of the distance between the two.
[[nodiscard]] inline double least_distance(const Edge& a, const Edge& b) {
  const auto gap = [](const Edge& line, const Edge& other) {
    const double from = glm::dot(other.from - line.from, line.inward);
    const double to = glm::dot(other.to - line.from, line.inward);
    return from * to > 0.0 ? std::min(std::abs(from), std::abs(to)) : 0.0;
  };
  return std::max(gap(a, b), gap(b, a));
}

/// The smallest ball that spans a wall between two faces of one piece, by the definition of
/// `min_wall`; empty if there is none with less than `limit` as its diameter.
[[nodiscard]] Ball least_ball(const Face& a, const Face& b, double perimeter, double limit);

/// The same of the balls that touch `a` at a place from 0 (its begin) to 1 (its end).
[[nodiscard]] Ball least_ball_at(const Face& a, double place, const Face& b, double perimeter,
                                 double limit);

/// The parts of a piece on the axis. A ball centred there touches a face and its mirror image; the
/// boundary between the two runs to the axis and back.
class AxisClay {
 public:
  AxisClay(const EdgeTree& tree, std::uint32_t piece);
  /// The smallest ball centred on the axis, in clay, that touches the face and spans a wall.
  [[nodiscard]] Ball least_ball(const Face& face) const;
  /// The same at a place from 0 (the face's begin) to 1 (its end).
  [[nodiscard]] Ball ball_at(const Face& face, double place) const;
  /// Lower bound of the diameter of any such ball for a node's faces; infinite if every such ball
  /// is larger than `limit`.
  [[nodiscard]] double bound(const EdgeNode& node, double limit) const;

 private:
  struct Stretch {
    double low = 0.0, high = 0.0;
  };
  /// The boundary between two stretches [mm of arc].
  struct Run {
    double begin = 0.0, end = 0.0;
  };
  [[nodiscard]] Ball least_ball(const Face& face, double from, double to) const;
  [[nodiscard]] bool has_clay(double y) const;

  std::vector<Stretch> stretches_;  ///< from the bottom up
  std::vector<Run> runs_;           ///< by arc
};

}  // namespace clay::solid::inline walls
