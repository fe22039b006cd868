#pragma once
// The definition of wall thickness, point against point: slow, and by angles.

#include "claystack/export/walls.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>
#include <vector>

namespace clay::solid {

class WallOracle {
 public:
  explicit WallOracle(const Profile& profile) {
    for (const Polygon& polygon : profile.pieces) pieces_.push_back(piece_of(polygon));
  }

  /// The thickness between the two places by the definition; infinite if they are no wall.
  double thickness(const Wall& wall) const {
    if (wall.to.rho < 0.0) return thickness_across(wall.from);
    double least = kNone;
    for (const Piece& piece : pieces_)
      for (const Edge& a : piece.edges)
        for (const Edge& b : piece.edges) {
          const double s = along(a, wall.from), t = along(b, wall.to);
          if (&a != &b && s >= 0.0 && t >= 0.0) least = std::min(least, between(piece, a, s, b, t));
        }
    return least;
  }

  /// The minimum over the ends of all edges and some places on them. With `margin`, only pairs
  /// count that stay walls for any displacement along their edges.
  double least_of_samples(std::mt19937_64& random, bool margin) {
    margin_ = margin ? 3.0 : 0.0;
    std::uniform_real_distribution<double> uniform;
    double least = kNone;
    for (const Piece& piece : pieces_)
      for (const Edge& a : piece.edges) {
        for (const double s : {0.0, 1.0, uniform(random)}) {
          if (const double t = thickness_across(at(a, s)); t < least) least = t;
          for (const Edge& b : piece.edges)
            for (const double t : {0.0, 1.0, uniform(random), uniform(random)})
              if (&a != &b) least = std::min(least, between(piece, a, s, b, t));
        }
      }
    margin_ = 0.0;
    return least;
  }

 private:
  static constexpr double kNone = std::numeric_limits<double>::infinity();
  static constexpr double kDegree = M_PI / 180.0;

  struct Edge {
    ProfilePoint from, to;
    double length = 0.0, begin = 0.0;  ///< along the polygon; axis edges have infinite length
    double normal = 0.0;               ///< its angle
    double turn_before = 0.0, turn_after = 0.0;
    bool axis = false;
  };
  struct Piece {
    std::vector<Edge> edges;  ///< off the axis
    std::vector<Edge> axis;
    double perimeter = 0.0;
  };

  static double wrapped(double angle) { return std::remainder(angle, 2.0 * M_PI); }

  static Piece piece_of(const Polygon& polygon) {
    std::vector<Edge> all(polygon.size());
    Piece piece;
    for (std::size_t i = 0; i < polygon.size(); ++i) {
      Edge& e = all[i];
      e.from = polygon[i], e.to = polygon[(i + 1) % polygon.size()];
      e.axis = e.from.rho == 0.0 && e.to.rho == 0.0;
      e.length = std::hypot(e.to.rho - e.from.rho, e.to.y - e.from.y);
      e.begin = piece.perimeter;
      e.normal = std::atan2(e.to.y - e.from.y, e.to.rho - e.from.rho) + M_PI / 2;
      piece.perimeter += e.axis ? 1e5 : e.length;
    }
    for (std::size_t i = 0; i < all.size(); ++i) {
      const Edge& before = all[(i + all.size() - 1) % all.size()];
      const Edge& after = all[(i + 1) % all.size()];
      const double mirror = M_PI - all[i].normal;
      all[i].turn_before = wrapped(all[i].normal - (before.axis ? mirror : before.normal));
      all[i].turn_after = wrapped((after.axis ? mirror : after.normal) - all[i].normal);
    }
    for (const Edge& e : all) (e.axis ? piece.axis : piece.edges).push_back(e);
    return piece;
  }

  static ProfilePoint at(const Edge& e, double s) {
    if (s == 1.0) return e.to;
    return {e.from.rho + s * (e.to.rho - e.from.rho), e.from.y + s * (e.to.y - e.from.y)};
  }

  /// The position of `p` on the edge, or -1 if it is elsewhere.
  static double along(const Edge& e, const ProfilePoint& p) {
    const double s = std::clamp(
        ((p.rho - e.from.rho) * (e.to.rho - e.from.rho) + (p.y - e.from.y) * (e.to.y - e.from.y)) /
            (e.length * e.length),
        0.0, 1.0);
    const ProfilePoint q = at(e, s);
    if (std::hypot(p.rho - q.rho, p.y - q.y) > 1e-9) return -1.0;
    return s < 1e-9 ? 0.0 : s > 1.0 - 1e-9 ? 1.0 : s;
  }

  /// Distance of `angle` from the fan of normals at place s of the edge [rad].
  static double outside(const Edge& e, double s, double angle) {
    const double turn = s == 0.0 ? -e.turn_before : s == 1.0 ? e.turn_after : 0.0;
    const double away = wrapped(angle - e.normal);
    // Counterclockwise polygons turn clockwise at reentrant corners.
    const bool reentrant = s == 0.0 ? e.turn_before < 0.0 : s == 1.0 && e.turn_after < 0.0;
    if (!reentrant) return std::abs(away);
    return std::max({std::min(0.0, turn) - away, away - std::max(0.0, turn), 0.0});
  }

  static bool is_corner(const Edge& e, double s) {
    return (s == 0.0 && e.turn_before < 0.0) || (s == 1.0 && e.turn_after < 0.0);
  }

  double between(const Piece& piece, const Edge& a, double s, const Edge& b, double t) const {
    const ProfilePoint p = at(a, s), q = at(b, t);
    const double d = std::hypot(q.rho - p.rho, q.y - p.y);
    if (d == 0.0) {
      const double interior = M_PI - std::abs(wrapped(a.normal - b.normal));
      const bool convex = s == 1.0 ? a.turn_after > 0.0 : a.turn_before > 0.0;
      return convex && has_balls_at_tip(interior) ? 0.0 : kNone;
    }
    const double way = std::atan2(q.y - p.y, q.rho - p.rho);
    const double off_a = std::abs(wrapped(way - a.normal));
    const double off_b = std::abs(wrapped(way + M_PI - b.normal));
    double least = kNone;
    if (std::abs(wrapped(a.normal - b.normal)) > M_PI / 2 && off_a < M_PI / 2 && off_b < M_PI / 2)
      least = if_wall(d / std::cos(std::min(off_a, off_b)), piece, a, s, b, t);
    const bool fits_a = is_corner(a, s) && outside(a, s, way) <= 0.0;
    const bool fits_b = is_corner(b, t) && outside(b, t, way + M_PI) <= 0.0;
    double at_corner = kNone;
    if (fits_a && fits_b) at_corner = d;
    if (fits_a && !fits_b && off_b < M_PI / 2) at_corner = d;
    if (fits_b && !fits_a && off_a < M_PI / 2) at_corner = d;
    return std::min(least, if_wall(at_corner, piece, a, s, b, t));
  }

  /// Whether a disc that touches one side of a wedge and passes through the other can have three
  /// diameters of boundary, tried with 100 000 pairs of places.
  static bool has_balls_at_tip(double interior) {
    for (int k = 1; k < 100'000; ++k) {
      const double x = k / 50'000.0;  // along the side that is touched; the other place is at 1
      const double d2 = x * x + 1.0 - 2.0 * x * std::cos(interior);
      if (x + 1.0 >= 3.0 * d2 / std::sin(interior)) return true;
    }
    return false;
  }

  /// The thickness, or none if the boundary around it is too short.
  double if_wall(double thickness, const Piece& piece, const Edge& a, double s, const Edge& b,
                 double t) const {
    if (a.begin > b.begin) return if_wall(thickness, piece, b, t, a, s);
    if (thickness == kNone) return kNone;
    const double from = a.begin + s * a.length, to = b.begin + t * b.length;
    const double least =
        3.0 * thickness - 1e-8 * (1.0 + thickness) + margin_ * (a.length + b.length);
    return to - from > least && piece.perimeter - (to - from) > least ? thickness : kNone;
  }

  /// Of balls centred on the axis, where `p` lies on a steep enough outside.
  double thickness_across(const ProfilePoint& p) const {
    double least = kNone;
    for (const Piece& piece : pieces_)
      for (const Edge& e : piece.edges) {
        const double s = along(e, p);
        if (s < 0.0) continue;
        const double lean = wrapped(e.normal - M_PI);
        double t = kNone;
        if (std::abs(lean) < M_PI / 4) t = across(piece, p, -std::tan(lean), std::cos(lean));
        if (is_corner(e, s) && outside(e, s, M_PI) <= 0.0)
          t = std::min(t, across(piece, p, 0.0, 1.0));
        if (2.0 * to_axis(piece, e.begin + s * e.length) > 3.0 * t - 1e-8 * (1.0 + t))
          least = std::min(least, t);
      }
    return least;
  }

  /// From a place on the boundary to the axis, the shorter way.
  static double to_axis(const Piece& piece, double arc) {
    double way = kNone;
    for (const Edge& axis : piece.axis)
      for (const double turn : {-piece.perimeter, 0.0, piece.perimeter})
        for (const double end : {axis.begin, axis.begin + 1e5})
          if (const double d = std::abs(end + turn - arc); d < way) way = d;
    return way;
  }

  static double across(const Piece& piece, const ProfilePoint& p, double rise, double slant) {
    const double centre = p.y + rise * p.rho;
    for (const Edge& axis : piece.axis)
      if (centre > std::min(axis.from.y, axis.to.y) - 1e-9 &&
          centre < std::max(axis.from.y, axis.to.y) + 1e-9)
        return 2.0 * p.rho / slant;
    return kNone;
  }

  std::vector<Piece> pieces_;
  double margin_ = 0.0;  ///< of the boundary around a wall, in lengths of both edges
};

}  // namespace clay::solid
