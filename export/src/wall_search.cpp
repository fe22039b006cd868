#include "wall_search.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace clay::solid {
namespace {

constexpr double kOpposite = 2.0 * std::numbers::pi / 3.0;

/// What the boundary between the far ends of two faces must measure, in thicknesses. Half a
/// circle's would be pi / 2; the chords around it are a little less.
constexpr double kRidge = 1.5;

/// The shorter way along the polygon that holds all of `a` and `b`.
template <class A, class B>
double arc_around(const A& a, const B& b, double perimeter) {
  const double begin = std::min(a.arc_begin, b.arc_begin), end = std::max(a.arc_end, b.arc_end);
  const double between = std::max(a.arc_begin, b.arc_begin) - std::min(a.arc_end, b.arc_end);
  return std::min(end - begin, perimeter - between);
}

}  // namespace

double WallSearch::bound(const EdgeNode& a, const EdgeNode& b) const {
  constexpr double kNone = std::numeric_limits<double>::infinity();
  if (a.last_piece < b.first_piece || b.last_piece < a.first_piece) return kNone;
  if (greatest_turn(a, b) < kOpposite) return kNone;
  if (&a == &b) return 0.0;
  const double distance = least_distance(a, b);
  const bool one_piece = a.first_piece == a.last_piece && b.first_piece == b.last_piece;
  if (one_piece && arc_around(a, b, tree_.perimeter(a.first_piece)) < kRidge * distance)
    return kNone;
  return distance;
}

void WallSearch::compare(const Face& a, const Face& b) {
  if (!opposite(a.edge.inward, b.edge.inward) && !a.has_corners() && !b.has_corners()) return;
  if (least_distance(a.edge, b.edge) >= best()) return;
  const Ball ball = least_ball(a, b);
  if (ball.diameter < least_.diameter &&
      arc_around(a, b, tree_.perimeter(a.piece)) >= kRidge * ball.diameter)
    least_ = ball;
}

void WallSearch::leaves(const EdgeNode& a, const EdgeNode& b) {
  const LeafFaces second(tree_, b);
  if (sample_) {
    for (const Face& face : second)
      if (face.edge.index != sample_->edge.index) compare(*sample_, face);
    return;
  }
  const LeafFaces first(tree_, a);
  for (const Face& face : first)
    for (const Face& other : second)
      if (&a != &b || face.edge.index < other.edge.index) compare(face, other);
}

void WallSearch::across(const AxisClay& axis, std::uint32_t piece, std::size_t node) {
  const EdgeNode& here = tree_.nodes()[node];
  if (piece < here.first_piece || piece > here.last_piece || axis.bound(here) >= best()) return;
  if (here.leaves > 1) {
    across(axis, piece, EdgeTree::left(node));
    across(axis, piece, tree_.right(node));
    return;
  }
  for (const Face& face : LeafFaces(tree_, here)) offer(axis.least_ball(face));
}

void WallSearch::from(const Face& sample) {
  EdgeNode node;
  node.centre = 0.5 * (sample.edge.from + sample.edge.to);
  node.half_length = node.half_width = 0.5 * glm::length(sample.edge.to - sample.edge.from);
  node.normal_angle = std::atan2(sample.edge.inward.y, sample.edge.inward.x);
  node.normal_spread = 0.0;
  node.arc_begin = sample.arc_begin, node.arc_end = sample.arc_end;
  node.first_piece = node.last_piece = sample.piece;
  sample_ = &sample;
  search_from(tree_, node, *this);
  sample_ = nullptr;
}

}  // namespace clay::solid
