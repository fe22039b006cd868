#pragma once
// References for smoothing: radii, volumes and walls of a section, computed by other means than in
// the library. Long double and O(n^2), on purpose.

#include "claystack/engine/clay.hpp"
#include "claystack/export/section.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

namespace clay::solid::oracles {

using Real = long double;

struct Point {
  Real rho = 0, y = 0;
};
using Line = std::vector<Point>;

/// Both walls of a section from the bottom up; the bore runs along the axis where there is none.
struct Walls {
  Line outer, bore;
};

/// A section begins at the foot of its outer wall, which ends with the first point at the top.
inline Walls walls_of(const Polygon& section) {
  Real top = section.front().y;
  for (const ProfilePoint& p : section) top = std::max<Real>(top, p.y);
  Walls walls;
  std::size_t i = 0;
  do walls.outer.push_back({section[i].rho, section[i].y});
  while (section[i++].y < top);
  for (std::size_t k = section.size(); k-- > i;)
    walls.bore.push_back({section[k].rho, section[k].y});
  return walls;
}

/// Heights of the rings `first` to `last`, crown included where they are the topmost.
inline std::vector<Real> levels_of(const ClayStack& stack, std::size_t first, std::size_t last) {
  std::vector<Real> levels;
  for (std::size_t i = first; i <= last + 1; ++i)
    levels.push_back(i == stack.size() ? stack.height_mm()
                                       : static_cast<double>(i) * stack.ring_height_mm());
  return levels;
}

inline Walls steps_of(const ClayStack& stack, std::size_t first, std::size_t last) {
  const std::vector<Real> levels = levels_of(stack, first, last);
  Walls walls;
  for (std::size_t i = first; i <= last; ++i)
    for (const Real y : {levels[i - first], levels[i - first + 1]}) {
      walls.outer.push_back({stack.rings()[i].outer_mm(), y});
      walls.bore.push_back({stack.rings()[i].inner_mm(), y});
    }
  return walls;
}

struct Edge {
  Point a, b;
};

/// The parts of a wall between two heights: rising edges clipped, level ones whole. Edges along the
/// axis are no wall: they are left out unless `axis`.
inline std::vector<Edge> between(const Line& line, Real low, Real high, bool axis = false) {
  std::vector<Edge> edges;
  for (std::size_t i = 0; i + 1 < line.size(); ++i) {
    const Point &a = line[i], &b = line[i + 1];
    if (!axis && a.rho == 0 && b.rho == 0) continue;
    if (a.y == b.y) {
      if (low <= a.y && a.y <= high) edges.push_back({a, b});
      continue;
    }
    const Real from = std::max(a.y, low), to = std::min(b.y, high);
    if (!(from < to)) continue;
    const Real slope = (b.rho - a.rho) / (b.y - a.y);
    edges.push_back({{from == a.y ? a.rho : a.rho + slope * (from - a.y), from},
                     {to == b.y ? b.rho : a.rho + slope * (to - a.y), to}});
  }
  return edges;
}

/// Integral of rho^2 dy between two heights: volume over pi.
inline Real swept_over_pi(const Line& line, Real low, Real high) {
  Real sum = 0;
  for (const auto& [a, b] : between(line, low, high))
    sum += (b.y - a.y) * (a.rho * a.rho + a.rho * b.rho + b.rho * b.rho) / 3;
  return sum;
}

inline Real distance(const Point& p, const Edge& e) {
  const Real rho = e.b.rho - e.a.rho, y = e.b.y - e.a.y, length2 = rho * rho + y * y;
  Real t = length2 > 0 ? ((p.rho - e.a.rho) * rho + (p.y - e.a.y) * y) / length2 : 0;
  t = std::min<Real>(1, std::max<Real>(0, t));
  return std::hypot(p.rho - e.a.rho - t * rho, p.y - e.a.y - t * y);
}

/// 0 if the edges cross, which Cramer's rule shows.
inline Real distance(const Edge& e, const Edge& f) {
  const Real e_rho = e.b.rho - e.a.rho, e_y = e.b.y - e.a.y;
  const Real f_rho = f.b.rho - f.a.rho, f_y = f.b.y - f.a.y;
  const Real det = e_rho * f_y - e_y * f_rho;
  if (det != 0) {
    const Real rho = f.a.rho - e.a.rho, y = f.a.y - e.a.y;
    const Real s = (rho * f_y - y * f_rho) / det, t = (rho * e_y - y * e_rho) / det;
    if (s >= 0 && s <= 1 && t >= 0 && t <= 1) return 0;
  }
  return std::min({distance(e.a, f), distance(e.b, f), distance(f.a, e), distance(f.b, e)});
}

/// By ring: the least distance from the walls at its heights to the opposite wall at any; twice
/// the radius where there is no bore.
inline std::vector<Real> walls_by_ring(const ClayStack& stack, std::size_t first, std::size_t last,
                                       const Walls& walls) {
  const std::vector<Real> levels = levels_of(stack, first, last);
  const std::vector<Edge> outer = between(walls.outer, levels.front(), levels.back());
  const std::vector<Edge> bore = between(walls.bore, levels.front(), levels.back());
  std::vector<Real> result;
  for (std::size_t i = first; i <= last; ++i) {
    const Real low = levels[i - first], high = levels[i - first + 1];
    Real least = 1e300L;
    for (const Edge& e : between(walls.bore, low, high))
      for (const Edge& f : outer) least = std::min(least, distance(e, f));
    for (const Edge& e : between(walls.outer, low, high)) {
      for (const Edge& f : bore) least = std::min(least, distance(e, f));
      if (stack.rings()[i].inner2 == 0) least = std::min({least, 2 * e.a.rho, 2 * e.b.rho});
    }
    result.push_back(least);
  }
  return result;
}

/// Least and largest radius of a wall between two heights.
inline std::pair<Real, Real> radii(const Line& line, Real low, Real high) {
  Real least = 1e300L, most = 0;
  for (const auto& [a, b] : between(line, low, high, true)) {
    least = std::min({least, a.rho, b.rho});
    most = std::max({most, a.rho, b.rho});
  }
  return {least, most};
}

}  // namespace clay::solid::oracles
