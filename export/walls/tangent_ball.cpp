#include "export/walls/tangent_ball.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace clay::solid::inline walls {
namespace {

constexpr double kRounding = 1e-9;  // of a length of boundary
constexpr double kArcRounding = 16.0 * std::numeric_limits<double>::epsilon();  // of the perimeter
// Two edges that meet at this angle or less have balls at the corner itself: with edges of lengths
// x and z x, the ratio of diameter and boundary is least at z = 2 cos(angle / 2) - 1, where it is
// 2 tan(angle / 4).
const double kSharp = 4.0 * std::atan(0.5 / kSpan);

/// The part of a face that counts, by the place along it: 0 at its begin, 1 at its end.
struct Line {
  Vec2 origin, along;
  double arc, arc_along;
  double low = 0.0, high = 1.0;

  explicit Line(const Face& face)
      : origin(face.edge.from),
        along(face.edge.to - face.edge.from),
        arc(face.arc_begin),
        arc_along(face.arc_end - face.arc_begin) {}
  [[nodiscard]] Vec2 at(double place) const { return origin + place * along; }
  [[nodiscard]] double arc_at(double place) const { return arc + place * arc_along; }
  [[nodiscard]] double clamp(double place) const { return std::clamp(place, low, high); }
  [[nodiscard]] bool has(double place) const { return place >= low && place <= high; }

  /// Leaves the part in front of a face; false if nothing remains.
  bool clip(const Edge& edge) {
    const double begin = glm::dot(origin - edge.from, edge.inward);
    const double rise = glm::dot(along, edge.inward);
    if (begin <= 0.0 && begin + rise <= 0.0) return false;
    if (begin < 0.0) low = std::max(low, std::min(-begin / rise, 1.0));
    if (begin + rise < 0.0) high = std::min(high, std::max(-begin / rise, 0.0));
    return low <= high;
  }
};

double nearest(const Vec2& p, const Line& line) {
  const double square = glm::dot(line.along, line.along);
  return line.clamp(square > 0.0 ? glm::dot(p - line.origin, line.along) / square : line.low);
}

/// The place on `line` for which the ball with `normal` at `p` is smallest: with d = a + t b from
/// p, |d|^2 / (d n) is convex in t and minimal where d n = |(b n) a - (a n) b| / |b|.
double least_tangent(const Vec2& p, const Vec2& normal, const Line& line) {
  const Vec2 a = line.origin - p, &b = line.along;
  const double an = glm::dot(a, normal), bn = glm::dot(b, normal), bb = glm::dot(b, b);
  const double height = bb > 0.0 ? glm::length(bn * a - an * b) / std::sqrt(bb) : 0.0;
  const double scale = bb * (height + an);
  return line.clamp(scale > 0.0 ? (bn * glm::dot(a, a) - 2.0 * an * glm::dot(a, b)) / scale
                                : line.low);
}

/// Calls `visit` with the real roots of a x^2 + b x + c.
template <class Visit>
void each_root(double a, double b, double c, Visit visit) {
  const double square = b * b - 4.0 * a * c;
  if (!(square >= 0.0)) return;
  const double q = -0.5 * (b + std::copysign(std::sqrt(square), b));
  if (a != 0.0) visit(q / a);
  if (q != 0.0) visit(c / q);
}

/// Searches the balls between two faces.
class BallSearch {
 public:
  BallSearch(double perimeter, double limit) : perimeter_(perimeter) { least_.diameter = limit; }

  /// Empty if none is smaller than the limit.
  [[nodiscard]] Ball least() const {
    Ball ball = found_ ? least_ : Ball{};
    ball.excluded = excluded_;
    return ball;
  }

  void edges(const Face& a, const Face& b) {
    if (!opposite(a.edge.inward, b.edge.inward) || meet(a, b) || meet(b, a)) return;
    Line on_a(a), on_b(b);
    if (!on_b.clip(a.edge) || !on_a.clip(b.edge)) return;
    touching(on_a, a.edge.inward, on_b);
    swapped_ = true;
    touching(on_b, b.edge.inward, on_a);
    swapped_ = false;
  }

  /// Balls that touch the reentrant corners of `a`; `swapped` if the caller has them in reverse.
  void corners(const Face& a, const Face& b, bool swapped) {
    swapped_ = swapped;
    const Line on_a(a), on_b(b);
    a.each_corner([&](const ReentrantCorner& corner, double u) {
      const auto offer = [&](double v, auto fits) {
        const Vec2 d = on_b.at(v) - corner.at;
        if (corner.faces(d) && fits(d)) keep(on_a, u, on_b, v, glm::length(d));
      };
      const auto on_edge = [&](double v) {
        if (on_b.has(v)) offer(v, [&](const Vec2& d) { return glm::dot(d, b.edge.inward) < 0.0; });
      };
      on_edge(nearest(corner.at, on_b));
      each_way(on_a, on_b, [&](const Way& way) {
        const Vec2 d = on_b.origin - corner.at, &e = on_b.along;
        const double at = way.begin + way.per_u * u, per = way.per_v;
        each_root(kSpan * kSpan * glm::dot(e, e) - per * per,
                  2.0 * (kSpan * kSpan * glm::dot(d, e) - at * per),
                  kSpan * kSpan * glm::dot(d, d) - at * at, on_edge);
      });
      b.each_corner([&](const ReentrantCorner& other, double v) {
        offer(v, [&](const Vec2& d) { return other.faces(-d); });
      });
    });
    swapped_ = false;
  }

  /// Balls that touch `a` at `u`.
  void at_place(const Face& a, double u, const Face& b) {
    Line on_a(a), on_b(b);
    const Vec2 &p = on_a.at(u), &normal = a.edge.inward;
    on_a.low = on_a.high = u;
    const bool in_front = glm::dot(p - b.edge.from, b.edge.inward) > 0.0;
    if (in_front && opposite(normal, b.edge.inward) && on_b.clip(a.edge)) {
      touch(on_a, u, normal, on_b, least_tangent(p, normal, on_b));
      each_way(on_a, on_b, [&](const Way& way) { limits_along_b(way, on_a, u, normal, on_b); });
    }
    const Line whole(b);
    b.each_corner([&](const ReentrantCorner& corner, double v) {
      if (corner.faces(p - corner.at)) touch(on_a, u, normal, whole, v);
    });
  }

 private:
  /// The boundary from a place u on one face to v on the other: begin + per_u u + per_v v.
  struct Way {
    double begin, per_u, per_v;
  };
  template <class Visit>
  void each_way(const Line& a, const Line& b, Visit visit) const {
    const double sign = a.arc < b.arc ? 1.0 : -1.0;
    const Way way{sign * (b.arc - a.arc), -sign * a.arc_along, sign * b.arc_along};
    visit(way);
    visit(Way{perimeter_ - way.begin, -way.per_u, -way.per_v});
  }

  /// True if `b` follows `a`. Then they meet in a notch of air, or in an edge. The balls of a sharp
  /// edge become arbitrarily small; those of any other have too little boundary.
  bool meet(const Face& a, const Face& b) {
    if (a.edge.to != b.edge.from) return false;
    const double cosine = -glm::dot(a.edge.inward, b.edge.inward);
    if (cross(a.edge.inward, b.edge.inward) > 0.0 && cosine >= std::cos(kSharp)) {
      found_ = true;
      least_.diameter = 0.0;
      least_.from = least_.to = a.edge.to;
    }
    return true;
  }

  void keep(const Line& a, double u, const Line& b, double v, double diameter) {
    if (!(diameter < least_.diameter)) return;
    const double around = std::abs(b.arc_at(v) - a.arc_at(u));
    if (std::min(around, perimeter_ - around) + kArcRounding * perimeter_ <
        kSpan * diameter * (1.0 - kRounding)) {
      excluded_ = std::min(excluded_, diameter);
      return;
    }
    found_ = true;
    least_.diameter = diameter;
    least_.from = a.at(u), least_.to = b.at(v);
    if (swapped_) std::swap(least_.from, least_.to);
  }

  /// Offers the ball with `normal` at u that passes through v. Returns its diameter.
  double touch(const Line& a, double u, const Vec2& normal, const Line& b, double v) {
    const Vec2 d = b.at(v) - a.at(u);
    const double height = glm::dot(d, normal);
    if (!(height > 0.0)) return Ball{}.diameter;
    const double diameter = glm::dot(d, d) / height;
    keep(a, u, b, v, diameter);
    return diameter;
  }

  /// Balls with `normal` on `a` through a point of `b`. The diameter |d|^2 / (d n) is convex over
  /// the parallelogram b - a, without a minimum inside because it grows in proportion to d. The
  /// boundary is linear. So the smallest ball with enough boundary is the smallest of all, or has
  /// just enough.
  void touching(const Line& a, const Vec2& normal, const Line& b) {
    double smallest = Ball{}.diameter;
    const double limit = least_.diameter;
    for (const double u : {a.low, a.high})
      smallest = std::min(smallest, touch(a, u, normal, b, least_tangent(a.at(u), normal, b)));
    for (const double v : {b.low, b.high})
      smallest = std::min(smallest, touch(a, nearest(b.at(v), a), normal, b, v));
    if (smallest >= limit || least_.diameter <= smallest) return;
    each_way(a, b, [&](const Way& way) {
      for (const double u : {a.low, a.high}) limits_along_b(way, a, u, normal, b);
      for (const double v : {b.low, b.high}) limits_along_a(way, a, normal, b, v);
      limits_inside(way, a, normal, b);
    });
  }

  /// kSpan |d|^2 = (d n) boundary, over v.
  void limits_along_b(const Way& way, const Line& a, double u, const Vec2& normal, const Line& b) {
    const Vec2 d = b.origin - a.at(u), &e = b.along;
    const double at = way.begin + way.per_u * u, dn = glm::dot(d, normal), en = glm::dot(e, normal);
    each_root(kSpan * glm::dot(e, e) - way.per_v * en,
              2.0 * kSpan * glm::dot(d, e) - at * en - way.per_v * dn,
              kSpan * glm::dot(d, d) - at * dn, [&](double v) {
                if (b.has(v)) touch(a, u, normal, b, v);
              });
  }

  /// The same over u, along which d n is constant.
  void limits_along_a(const Way& way, const Line& a, const Vec2& normal, const Line& b, double v) {
    const Vec2 d = b.at(v) - a.origin, &e = a.along;
    const double at = way.begin + way.per_v * v, height = glm::dot(d, normal);
    each_root(kSpan * glm::dot(e, e), -2.0 * kSpan * glm::dot(d, e) - way.per_u * height,
              kSpan * glm::dot(d, d) - at * height, [&](double u) {
                if (a.has(u)) touch(a, u, normal, b, v);
              });
  }

  /// Where the gradients of diameter and boundary are parallel, d has the direction g = n + m t: of
  /// degree 1 in d, the diameter has a gradient that depends on the direction alone. Two linear
  /// equations in u and v remain.
  void limits_inside(const Way& way, const Line& a, const Vec2& normal, const Line& b) {
    const Vec2 tangent{-normal.y, normal.x};
    const Vec2 both = a.along / a.arc_along - b.along / b.arc_along;
    const double across = glm::dot(both, normal), along = glm::dot(both, tangent);
    const auto solve = [&](double m) {
      const Vec2 g = normal + m * tangent, d = b.origin - a.origin;
      const double uu = -cross(g, a.along), uv = cross(g, b.along), uw = -cross(g, d);
      const double vu = -kSpan * glm::dot(a.along, g) - way.per_u;
      const double vv = kSpan * glm::dot(b.along, g) - way.per_v;
      const double vw = way.begin - kSpan * glm::dot(d, g);
      const double determinant = uu * vv - uv * vu;
      if (determinant == 0.0) return;
      const double u = (uw * vv - uv * vw) / determinant, v = (uu * vw - uw * vu) / determinant;
      if (a.has(u) && b.has(v)) touch(a, u, normal, b, v);
    };
    if (across == 0.0) return solve(0.0);
    each_root(across, -2.0 * along, -across, solve);
  }

  double perimeter_, excluded_ = Ball{}.excluded;
  Ball least_;
  bool found_ = false, swapped_ = false;
};

/// Places on a face whose balls on the axis end just where a stretch of clay does, or have just
/// enough boundary in a run.
template <class Stretches, class Run, class Offer>
void each_axis_limit(const Line& line, double slant, double rise, const Stretches& stretches,
                     const Run& run, const Offer& offer) {
  const double begin = line.origin.y + line.origin.x * rise;
  const double per = line.along.y + line.along.x * rise;
  const auto [low, high] = std::minmax({begin, begin + per});
  auto clay = std::partition_point(stretches.begin(), stretches.end(),
                                   [y = low](const auto& s) { return s.high < y; });
  for (; per != 0.0 && clay != stretches.end() && clay->low <= high; ++clay)
    for (const double y : {clay->low, clay->high}) offer((y - begin) / per);
  const double radius = kSpan * line.origin.x / slant, per_radius = kSpan * line.along.x / slant;
  if (const double slope = line.arc_along - per_radius; slope != 0.0)
    offer((radius - (line.arc - run.begin)) / slope);
  if (const double slope = line.arc_along + per_radius; slope != 0.0)
    offer((run.end - line.arc - radius) / slope);
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

Ball least_ball(const Face& a, const Face& b, double perimeter, double limit) {
  BallSearch search(perimeter, limit);
  search.edges(a, b);
  if (a.has_corners()) search.corners(a, b, false);
  if (b.has_corners()) search.corners(b, a, true);
  return search.least();
}

Ball least_ball_at(const Face& a, double place, const Face& b, double perimeter, double limit) {
  BallSearch search(perimeter, limit);
  search.at_place(a, place, b);
  return search.least();
}

AxisClay::AxisClay(const EdgeTree& tree, std::uint32_t piece) {
  double arc = 0.0;
  for (std::uint32_t i = tree.first_edge(piece);;) {
    const std::uint32_t next = tree.after(i, piece);
    const Edge edge = tree.edge(i, piece);
    const double begin = arc;
    arc += tree.arc_length(edge);
    if (edge.on_axis()) {
      const auto [low, high] = std::minmax(edge.from.y, edge.to.y);
      stretches_.push_back({low, high});
      if (!runs_.empty()) runs_.back().end = begin;
      runs_.push_back({arc, arc});
    }
    if (next <= i) break;
    i = next;
  }
  if (runs_.empty()) return;
  // The part before the first stretch belongs to the run after the last one.
  runs_.back().end = runs_.front().begin - tree.axis_arc() + arc;
  runs_.insert(runs_.begin(), {runs_.back().begin - arc, runs_.back().end - arc});
  std::sort(stretches_.begin(), stretches_.end(),
            [](const Stretch& a, const Stretch& b) { return a.low < b.low; });
}

double AxisClay::bound(const EdgeNode& node, double limit) const {
  const Vec2 along = glm::abs(node.along);
  const Vec2 reach = node.half_length * along + node.half_width * Vec2{along.y, along.x};
  const double up = reach.y + 0.5 * limit;
  const bool beyond = stretches_.empty() || node.centre.y + up < stretches_.front().low ||
                      node.centre.y - up > stretches_.back().high;
  return beyond ? std::numeric_limits<double>::infinity() : 2.0 * (node.centre.x - reach.x);
}

Ball AxisClay::least_ball(const Face& face) const { return least_ball(face, 0.0, 1.0); }

Ball AxisClay::ball_at(const Face& face, double place) const {
  return least_ball(face, place, place);
}

Ball AxisClay::least_ball(const Face& face, double from, double to) const {
  Ball best;
  if (stretches_.empty()) return best;
  const Line line(face);
  const auto run = std::prev(
      std::upper_bound(runs_.begin(), runs_.end(), line.arc,
                       [](double arc, const Run& r) { return arc < r.begin - kRounding; }));
  // Half of the boundary on the shorter way round.
  const auto half_way = [&](double u) {
    return std::min(run->end - line.arc_at(u), line.arc_at(u) - run->begin);
  };
  const auto touch = [&](double u, double slant) {
    const Vec2 p = line.at(u);
    const double diameter = 2.0 * p.x / slant;
    if (diameter < best.diameter &&
        half_way(u) >= 0.5 * kSpan * diameter * (1.0 - kRounding) - kRounding)
      best.diameter = diameter, best.from = p, best.to = mirrored(p);
  };
  face.each_corner([&](const ReentrantCorner& corner, double u) {
    if (u >= from && u <= to && corner.faces({-1.0, 0.0}) && has_clay(corner.at.y)) touch(u, 1.0);
  });
  const Vec2& normal = face.edge.inward;
  const double slant = -normal.x, rise = normal.y / slant;
  if (!opposite(normal, mirrored(normal)) || !(slant > 0.0)) return best;
  const auto offer = [&](double u) {
    if (u >= from && u <= to && has_clay(line.at(u).y + line.at(u).x * rise)) touch(u, slant);
  };
  offer(from);
  offer(to);
  each_axis_limit(line, slant, rise, stretches_, *run, offer);
  return best;
}

bool AxisClay::has_clay(double y) const {
  const auto clay = std::partition_point(stretches_.begin(), stretches_.end(),
                                         [&](const Stretch& s) { return s.high < y - kRounding; });
  return clay != stretches_.end() && clay->low <= y + kRounding;
}

}  // namespace clay::solid::inline walls
