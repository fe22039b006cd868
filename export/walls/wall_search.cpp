#include "export/walls/wall_search.hpp"

#include <algorithm>
#include <cmath>

namespace clay::solid::inline walls {
namespace {

constexpr double kNone = std::numeric_limits<double>::infinity();

/// The shorter way along the polygon that contains all of `a` and `b`.
double arc_around(const EdgeNode& a, const EdgeNode& b, double perimeter) {
  const double begin = std::min(a.arc_begin, b.arc_begin), end = std::max(a.arc_end, b.arc_end);
  const double between = std::max(a.arc_begin, b.arc_begin) - std::min(a.arc_end, b.arc_end);
  return std::min(end - begin, perimeter - between);
}

/// True for nodes that, at distance `distance`, cannot contain opposite faces of one piece that
/// span a wall.
bool no_wall_between(const EdgeTree& tree, const EdgeNode& a, const EdgeNode& b, double distance) {
  if (a.first_piece != a.last_piece || b.first_piece != b.last_piece) return false;
  return arc_around(a, b, tree.perimeter(a.first_piece)) < kSpan * distance;
}

bool no_opposites(const EdgeNode& a, const EdgeNode& b) {
  return a.last_piece < b.first_piece || b.last_piece < a.first_piece ||
         greatest_turn(a, b) < kOpposite;
}

}  // namespace

double WallSearch::bound(const EdgeNode& a, const EdgeNode& b) const {
  if (no_opposites(a, b)) return kNone;
  if (&a == &b) return 0.0;
  const double distance = least_distance(a, b);
  return no_wall_between(tree_, a, b, distance) ? kNone : distance;
}

void WallSearch::compare(const Face& a, const Face& b) {
  if (!may_face(a, b)) return;
  if (least_distance(a.edge, b.edge) >= best()) return;
  const Ball ball = least_ball(a, b, tree_.perimeter(a.piece), best());
  if (ball.diameter < best()) least_ = ball;
}

void WallSearch::leaves(const EdgeNode& a, const EdgeNode& b) {
  const LeafFaces first(tree_, a), second(tree_, b);
  for (const Face& face : first)
    for (const Face& other : second)
      if (&a != &b || face.edge.index < other.edge.index) compare(face, other);
}

void WallSearch::across(const AxisClay& axis, std::uint32_t piece, std::size_t node) {
  const EdgeNode& here = tree_.nodes()[node];
  if (piece < here.first_piece || piece > here.last_piece || axis.bound(here, best()) >= best())
    return;
  if (here.leaves > 1) {
    across(axis, piece, EdgeTree::left(node));
    across(axis, piece, tree_.right(node));
    return;
  }
  for (const Face& face : LeafFaces(tree_, here)) {
    const Ball ball = axis.least_ball(face);
    if (ball.diameter < best()) least_ = ball;
  }
}

Ball PlaceSearch::run(const AxisClay& axis) {
  least_ = axis.ball_at(face_, place_);
  least_.diameter = std::min(least_.diameter, below_);
  EdgeNode place;
  place.centre = at_;
  place.normal_angle = std::atan2(face_.edge.inward.y, face_.edge.inward.x);
  place.normal_spread = 0.0;
  place.arc_begin = place.arc_end = face_.arc_begin + place_ * (face_.arc_end - face_.arc_begin);
  place.first_piece = place.last_piece = face_.piece;
  search_from(tree_, place, *this);
  return least_;
}

double PlaceSearch::bound(const EdgeNode& place, const EdgeNode& node) {
  if (no_opposites(place, node)) return kNone;
  const Vec2& normal = face_.edge.inward;
  const double highest = glm::dot(node.centre - at_, normal) +
                         node.half_length * std::abs(glm::dot(node.along, normal)) +
                         node.half_width * std::abs(cross(node.along, normal));
  if (highest <= 0.0) return kNone;
  const double distance = least_distance(place, node);
  const double diameter = distance * std::max(1.0, distance / highest);
  if (!no_wall_between(tree_, place, node, distance)) return diameter;
  least_.excluded = std::min(least_.excluded, diameter);
  return kNone;
}

void PlaceSearch::leaves(const EdgeNode&, const EdgeNode& leaf) {
  for (const Face& other : LeafFaces(tree_, leaf)) {
    if (other.edge.index == face_.edge.index) continue;
    const Ball ball = least_ball_at(face_, place_, other, tree_.perimeter(face_.piece), best());
    const double excluded = std::min(least_.excluded, ball.excluded);
    if (ball.diameter < best()) {
      least_ = ball;
      least_.to_arc = other.arc_begin + glm::length(ball.to - other.edge.from);
    }
    least_.excluded = excluded;
  }
}

}  // namespace clay::solid::inline walls
