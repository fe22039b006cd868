#include "export/walls/tangent_ball.hpp"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>

namespace clay::solid::inline walls {
namespace {

/// Across the axis: limit of the inclination of the outside of a solid, as cosine and tangent.
const double kCosLean = std::sqrt(0.75), kTanLean = std::sqrt(1.0 / 3.0);

struct Segment {
  Vec2 from{0.0}, to{0.0};
  [[nodiscard]] Vec2 at(double t) const { return from + std::clamp(t, 0.0, 1.0) * (to - from); }
};

Vec2 nearest(const Vec2& p, const Segment& s) {
  const Vec2 along = s.to - s.from;
  const double square = glm::dot(along, along);
  return square > 0.0 ? s.at(glm::dot(p - s.from, along) / square) : s.from;
}

/// Clips the part behind the line through `origin`; false if nothing remains.
bool clip(Segment& s, const Vec2& origin, const Vec2& normal) {
  const double from = glm::dot(s.from - origin, normal), to = glm::dot(s.to - origin, normal);
  if (from <= 0.0 && to <= 0.0) return false;
  if (from < 0.0) s.from = s.at(from / (from - to));
  if (to < 0.0) s.to = s.at(to / (to - from));
  return true;
}

/// The point of `s` for which the ball with `normal` at `p` is smallest: with d = a + t b from p,
/// |d|^2 / (d n) is convex in t and minimal where d n = |(b n) a - (a n) b| / |b|.
Vec2 least_tangent(const Vec2& p, const Vec2& normal, const Segment& s) {
  const Vec2 a = s.from - p, b = s.to - s.from;
  const double an = glm::dot(a, normal), bn = glm::dot(b, normal), bb = glm::dot(b, b);
  const double height = bb > 0.0 ? glm::length(bn * a - an * b) / std::sqrt(bb) : 0.0;
  const double scale = bb * (height + an);
  return scale > 0.0 ? s.at((bn * glm::dot(a, a) - 2.0 * an * glm::dot(a, b)) / scale) : s.from;
}

/// Balls with `normal` on `a` through a point of `b`. Their diameter is |d|^2 / (d n) over the
/// parallelogram b - a, without an interior minimum because it grows in proportion to d.
void keep_touching(Balls& balls, const Segment& a, const Vec2& normal, const Segment& b) {
  const auto offer = [&](const Vec2& p, const Vec2& q) {
    const Vec2 d = q - p;
    const double height = glm::dot(d, normal);
    if (height > 0.0) balls.keep({glm::dot(d, d) / height, p, q});
  };
  for (const Vec2& p : {a.from, a.to}) offer(p, least_tangent(p, normal, b));
  for (const Vec2& q : {b.from, b.to}) offer(nearest(q, a), q);
}

void keep_at_corners(Balls& balls, const Face& a, const Face& b) {
  a.each_corner([&](const ReentrantCorner& corner) {
    const auto offer = [&](const Vec2& q, auto fits) {
      const Vec2 d = q - corner.at;
      if (corner.faces(d) && fits(d)) balls.keep({glm::length(d), corner.at, q, true});
    };
    offer(nearest(corner.at, {b.edge.from, b.edge.to}), [&](const Vec2& d) {
      return glm::dot(d, b.edge.inward) < -kMinusCosOpposite * glm::length(d);
    });
    b.each_corner([&](const ReentrantCorner& other) {
      offer(other.at, [&](const Vec2& d) { return other.faces(-d); });
    });
  });
}

/// Balls between opposite faces.
void keep_at_edges(Balls& balls, const Edge& a, const Edge& b) {
  // Two faces that meet form either a sharp edge or a notch with only air between them.
  if (a.to == b.from && cross(a.inward, b.inward) > 0.0) return balls.keep({0.0, a.to, a.to});
  if (b.to == a.from && cross(b.inward, a.inward) > 0.0) return balls.keep({0.0, a.from, a.from});
  Segment on_a{a.from, a.to}, on_b{b.from, b.to};
  if (!clip(on_b, a.from, a.inward) || !clip(on_a, b.from, b.inward)) return;
  keep_touching(balls, on_a, a.inward, on_b);
  balls.swap();
  keep_touching(balls, on_b, b.inward, on_a);
  balls.swap();
}

void keep(Ball& best, const Ball& ball) {
  if (ball.diameter < best.diameter) best = ball;
}

double arc_at(const Face& face, const Vec2& p) {
  return face.arc_begin + glm::length(p - face.edge.from);
}

}  // namespace

LeafFaces::LeafFaces(const EdgeTree& tree, const EdgeNode& leaf) {
  const std::uint32_t piece = leaf.first_piece;
  double arc = leaf.arc_begin;
  Vec2 before = tree.edge(tree.before(leaf.first, piece), piece).inward;
  for (std::uint32_t i = leaf.first; i < leaf.end; ++i) {
    const Edge edge = tree.edge(i, piece);
    const double begin = arc;
    arc += tree.arc_length(edge);
    if (!edge.on_axis()) {
      if (edge.from.x == 0.0) before = mirrored(edge.inward);
      const bool begins_reentrant = cross(before, edge.inward) < 0.0;
      const bool ends_reentrant =
          edge.to.x == 0.0 && cross(edge.inward, mirrored(edge.inward)) < 0.0;
      faces_[count_++] = {edge, begin, arc, piece, begins_reentrant, ends_reentrant, before};
    }
    before = edge.inward;
  }
}

bool is_wall(const Face& a, const Face& b, const Ball& ball, double perimeter) {
  if (a.arc_begin > b.arc_begin)
    return is_wall(b, a, {ball.diameter, ball.to, ball.from, ball.at_corner}, perimeter);
  const double from = arc_at(a, ball.from), to = arc_at(b, ball.to);
  const double most = ball.at_corner ? 0.0 : 0.5 * ball.diameter;
  const double beyond = std::min({from - a.arc_begin, b.arc_end - to, most});
  const double beyond_other_way = std::min({a.arc_end - from, to - b.arc_begin, most});
  const double around = to - from + 2.0 * beyond;
  const double other_way = perimeter - (to - from) + 2.0 * beyond_other_way;
  return std::min(around, other_way) >= kRidge * ball.diameter;
}

Balls balls_between(const Face& a, const Face& b, double limit) {
  Balls balls(limit);
  if (opposite(a.edge.inward, b.edge.inward)) keep_at_edges(balls, a.edge, b.edge);
  if (a.has_corners()) keep_at_corners(balls, a, b);
  if (b.has_corners()) {
    balls.swap();
    keep_at_corners(balls, b, a);
  }
  return balls;
}

Ball ball_at(const Vec2& p, const Face& a, const Face& b) {
  Ball best;
  const Vec2& normal = a.edge.inward;
  const auto offer = [&](const Vec2& q, bool at_corner) {
    const Vec2 d = q - p;
    const double height = glm::dot(d, normal);
    if (height > 0.0) keep(best, {glm::dot(d, d) / height, p, q, at_corner});
  };
  Segment on_b{b.edge.from, b.edge.to};
  const bool before_b = glm::dot(p - on_b.from, b.edge.inward) > 0.0;
  if (before_b && opposite(normal, b.edge.inward) && clip(on_b, p, normal))
    offer(least_tangent(p, normal, on_b), false);
  b.each_corner([&](const ReentrantCorner& corner) {
    const Vec2 d = corner.at - p;
    if (corner.faces(-d) && glm::dot(d, normal) > kMinusCosOpposite * glm::length(d))
      offer(corner.at, true);
  });
  return best;
}

AxisClay::AxisClay(const EdgeTree& tree, std::uint32_t piece) {
  for (std::uint32_t i = tree.first_edge(piece);;) {
    const std::uint32_t next = tree.after(i, piece);
    if (tree.point(i).x == 0.0 && tree.point(next).x == 0.0) {
      const auto [low, high] = std::minmax(tree.point(i).y, tree.point(next).y);
      stretches_.push_back({low, high});
    }
    if (next <= i) break;
    i = next;
  }
  std::sort(stretches_.begin(), stretches_.end(),
            [](const Stretch& a, const Stretch& b) { return a.low < b.low; });
}

double AxisClay::bound(const EdgeNode& node) const {
  const Vec2 along = glm::abs(node.along);
  const Vec2 reach = node.half_length * along + node.half_width * Vec2{along.y, along.x};
  // The radii of the balls are inclined no more than the normals.
  const double up = reach.y + (node.centre.x + reach.x) * kTanLean;
  const bool beyond = stretches_.empty() || node.centre.y + up < stretches_.front().low ||
                      node.centre.y - up > stretches_.back().high;
  return beyond ? std::numeric_limits<double>::infinity() : 2.0 * (node.centre.x - reach.x);
}

Ball AxisClay::least_ball(const Face& face) const {
  Ball best;
  const Vec2& normal = face.edge.inward;
  const auto touch = [&](const Vec2& p, double slant) {
    keep(best, {2.0 * p.x / slant, p, mirrored(p)});
  };
  const auto above = [&](double y) {
    return std::partition_point(stretches_.begin(), stretches_.end(),
                                [&](const Stretch& s) { return s.high < y; });
  };
  face.each_corner([&](const ReentrantCorner& corner) {
    const auto clay = above(corner.at.y);
    if (corner.faces({-1.0, 0.0}) && clay != stretches_.end() && clay->low <= corner.at.y)
      touch(corner.at, 1.0);
  });
  if (normal.x > -kCosLean) return best;
  // Heights of the centres of the balls that touch the two ends.
  const auto centre = [&](const Vec2& p) { return p.y - p.x * normal.y / normal.x; };
  const double from = centre(face.edge.from), to = centre(face.edge.to);
  const auto [low, high] = std::minmax(from, to);
  const Segment segment{face.edge.from, face.edge.to};
  for (auto clay = above(low); clay != stretches_.end() && clay->low <= high; ++clay)
    for (const double y : {std::max(low, clay->low), std::min(high, clay->high)})
      touch(from == to ? (face.edge.from.x < face.edge.to.x ? segment.from : segment.to)
                       : segment.at((y - from) / (to - from)),
            -normal.x);
  return best;
}

Ball AxisClay::ball_at(const Vec2& p, const Face& face) const {
  Face place = face;
  place.begins_reentrant = place.ends_reentrant = false;
  place.edge.from = place.edge.to = p;
  return least_ball(place);
}

}  // namespace clay::solid::inline walls
