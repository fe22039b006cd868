#include "export/smoothing/wall_guard.hpp"

#include "core/cancel.hpp"
#include "export/smoothing/fair_wall.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>
#include <utility>

namespace clay::solid::inline smoothing {
namespace {

/// Heights where clay reaches the axis.
struct SolidStretch {
  double bottom = 0.0, top = 0.0;
};

std::vector<SolidStretch> solid_stretches(const PieceWalls& piece) {
  std::vector<SolidStretch> stretches;
  for (std::size_t i = 0; i < piece.size(); ++i) {
    if (piece.bore.radius[i] > 0.0) continue;
    if (i > 0 && piece.bore.radius[i - 1] == 0.0)
      stretches.back().top = piece.level[i + 1];
    else
      stretches.push_back({piece.level[i], piece.level[i + 1]});
  }
  return stretches;
}

ProfilePoint point_at(const LineEdge& edge, double y) {
  if (y <= edge.from.y) return edge.from;
  if (y >= edge.to.y) return edge.to;
  const double t = (y - edge.from.y) / (edge.to.y - edge.from.y);
  return {edge.from.rho + t * (edge.to.rho - edge.from.rho), y};
}

/// The part of an edge between two heights. False if a rising edge only touches them with its end.
bool clip(LineEdge& edge, double bottom, double top) {
  if (edge.from.y == edge.to.y) return bottom <= edge.from.y && edge.from.y <= top;
  if (edge.to.y <= bottom || top <= edge.from.y) return false;
  edge = {point_at(edge, bottom), point_at(edge, top)};
  return true;
}

/// Calls `visit(first, end, edge)` for every edge of a wall and the rings at its heights. Edges
/// along the axis are not part of a wall.
template <class Visit>
void for_each_edge(const PieceWalls& piece, const Polygon& line, Visit visit) {
  std::size_t first = 0;
  for (std::size_t e = 0; e + 1 < line.size(); ++e) {
    step_of_loop();
    const LineEdge edge{line[e], line[e + 1]};
    while (first < piece.size() && piece.level[first + 1] < edge.from.y) ++first;
    std::size_t end = first;
    while (end < piece.size() && piece.level[end] <= edge.to.y) ++end;
    if (edge.from.rho > 0.0 || edge.to.rho > 0.0) visit(first, end, edge);
  }
}

/// Calls `visit(ring, edge)` for every edge of a wall, clipped to the heights of each flagged ring.
template <class Visit>
void for_each_clipped(const PieceWalls& piece, const Polygon& line, const RingFlags& rings,
                      Visit visit) {
  for_each_edge(piece, line, [&](std::size_t first, std::size_t end, const LineEdge& whole) {
    for (std::size_t i = first; i < end; ++i)
      if (LineEdge edge = whole; rings[i] != 0 && clip(edge, piece.level[i], piece.level[i + 1]))
        visit(i, edge);
  });
}

void keep_least(double& least, double found) { least = std::min(least, found); }

/// Twice the smallest radius of the outer wall where clay reaches the axis.
double least_across(const PieceWalls& piece, const Polygon& outer, double least) {
  const std::vector<SolidStretch> stretches = solid_stretches(piece);
  auto begin = stretches.begin();
  for (std::size_t e = 0; e + 1 < outer.size(); ++e) {
    while (begin != stretches.end() && begin->top < outer[e].y) ++begin;
    for (auto it = begin; it != stretches.end() && it->bottom <= outer[e + 1].y; ++it)
      if (LineEdge edge{outer[e], outer[e + 1]}; clip(edge, it->bottom, it->top))
        keep_least(least, 2.0 * std::min(edge.from.rho, edge.to.rho));
  }
  return least;
}

double through_clay(const LineTree& outer, const LineTree& bore, double bound) {
  return std::sqrt(outer.nearest2(bore, bound * bound));
}

/// Start value of the search for the minimum wall: the walls along the radius, treads included.
double least_radial(const PieceWalls& piece) {
  const auto &outer = piece.outer.radius, &bore = piece.bore.radius;
  double least = std::numeric_limits<double>::max();
  const auto add = [&](double outside, double inside) {
    keep_least(least, inside > 0.0 ? outside - inside : 2.0 * outside);
  };
  for (std::size_t i = 0; i < piece.size(); ++i) {
    add(outer[i], bore[i]);
    if (i > 0) add(std::min(outer[i - 1], outer[i]), std::max(bore[i - 1], bore[i]));
  }
  return least;
}

}  // namespace

Polygon outline_of(const WallLines& lines) {
  Polygon section = lines.outer;
  section.insert(section.end(), lines.bore.rbegin(), lines.bore.rend());
  return section;
}

WallLines lines_of(const Polygon& outline) {
  const auto lower = [](const ProfilePoint& a, const ProfilePoint& b) {
    return std::pair(a.y, -a.rho) < std::pair(b.y, -b.rho);
  };
  const auto higher = [](const ProfilePoint& a, const ProfilePoint& b) {
    return std::pair(a.y, a.rho) < std::pair(b.y, b.rho);
  };
  Polygon turned = outline;
  std::rotate(turned.begin(), std::ranges::min_element(turned, lower), turned.end());
  const auto rim = std::ranges::max_element(turned, higher) + 1;
  return {{turned.begin(), rim}, {turned.rbegin(), std::reverse_iterator(rim)}};
}

Polygon mirrored(Polygon line) {
  for (ProfilePoint& p : line) p.rho = -p.rho;
  return line;
}

WallLines stepped_lines(const PieceWalls& piece) {
  return {stepped_wall(piece, piece.outer), stepped_wall(piece, piece.bore)};
}

double least_own_wall_mm(const PieceWalls& piece) {
  const WallLines lines = stepped_lines(piece);
  double least = least_across(piece, lines.outer, least_radial(piece));
  for (const SolidStretch& stretch : solid_stretches(piece))
    keep_least(least, stretch.top - stretch.bottom);
  return through_clay(LineTree(lines.outer), LineTree(lines.bore), least);
}

bool WallGauge::thinner_than(double limit_mm) const {
  const double bound = limit_mm * kWallRounding;
  return least_across(piece_, lines_.outer, bound) < bound ||
         outer_.any_nearer2(bore_, bound * bound);
}

RingFlags WallGauge::rings_near_thin(double limit_mm) const {
  const double bound = limit_mm * kWallRounding, bound2 = bound * bound;
  RingFlags rings(piece_.size(), 0);
  const auto flag = [&](std::size_t first, std::size_t end) {
    std::fill(rings.begin() + static_cast<std::ptrdiff_t>(first),
              rings.begin() + static_cast<std::ptrdiff_t>(end), char{1});
  };
  for_each_edge(piece_, lines_.bore, [&](std::size_t first, std::size_t end, const LineEdge& edge) {
    if (outer_.any_nearer2(edge, bound2)) flag(first, end);
  });
  for_each_edge(
      piece_, lines_.outer, [&](std::size_t first, std::size_t end, const LineEdge& edge) {
        if (2.0 * std::min(edge.from.rho, edge.to.rho) < bound || bore_.any_nearer2(edge, bound2))
          flag(first, end);
      });
  return rings;
}

std::vector<double> WallGauge::by_ring_mm(double cap_mm, const RingFlags& rings) const {
  std::vector<double> walls(piece_.size(), cap_mm * cap_mm);
  for_each_clipped(piece_, lines_.bore, rings, [&](std::size_t i, const LineEdge& edge) {
    walls[i] = outer_.nearest2(edge, walls[i]);
  });
  for_each_clipped(piece_, lines_.outer, rings, [&](std::size_t i, const LineEdge& edge) {
    walls[i] = bore_.nearest2(edge, walls[i]);
    if (piece_.bore.radius[i] > 0.0) return;
    const double across = 2.0 * std::min(edge.from.rho, edge.to.rho);
    keep_least(walls[i], across * across);
  });
  for (double& wall : walls) wall = std::sqrt(wall);
  return walls;
}

const std::vector<double>& OwnWalls::by_ring_mm(const RingFlags& rings) {
  if (!gauge_) {
    gauge_.emplace(piece_, stepped_lines(piece_));
    measured_.assign(piece_.size(), 0);
    walls_mm_.assign(piece_.size(), cap_mm_);
  }
  RingFlags missing = rings;
  for (std::size_t i = 0; i < missing.size(); ++i)
    if (measured_[i] != 0) missing[i] = 0;
  if (std::ranges::find(missing, 1) == missing.end()) return walls_mm_;
  const std::vector<double> found = gauge_->by_ring_mm(cap_mm_, missing);
  for (std::size_t i = 0; i < missing.size(); ++i)
    if (missing[i] != 0) {
      walls_mm_[i] = found[i];
      measured_[i] = 1;
    }
  return walls_mm_;
}

}  // namespace clay::solid::inline smoothing
