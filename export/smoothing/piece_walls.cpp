#include "export/smoothing/piece_walls.hpp"

#include "core/cancel.hpp"

#include <algorithm>
#include <cmath>

namespace clay::solid::inline smoothing {
namespace {

constexpr double kFeatureRatio = 6.0;
constexpr double kFeatureHeights = 0.5;
constexpr std::size_t kFeatureReach = 3;

/// Appends a ring: its radius and the square of the radius.
void add_ring(WallRings& wall, Quanta square) {
  wall.radius.push_back(radius_from_quanta(square));
  wall.square.push_back(mm2_from_quanta(square));
}

double tread_mm(const WallRings& wall, std::size_t interface) {
  return std::abs(wall.radius[interface] - wall.radius[interface - 1]);
}

/// The two widest steps so far.
struct Widest {
  double first = 0.0, second = 0.0;
  std::size_t steps = 0;

  void add(double step) {
    ++steps;
    if (step > first) {
      second = first;
      first = step;
    } else {
      second = std::max(second, step);
    }
  }
};

/// `ends` marks the ends of the wall; steps beyond them belong to another wall.
bool is_feature(const PieceWalls& piece, const WallRings& wall, const CutFlags& ends,
                std::size_t interface) {
  const double tread = tread_mm(wall, interface);
  if (tread < kFeatureHeights * piece.ring_height_mm) return false;
  Widest others;
  for (std::size_t k = interface - 1; k + kFeatureReach >= interface && ends[k] == 0; --k)
    others.add(tread_mm(wall, k));
  for (std::size_t k = interface + 1; k <= interface + kFeatureReach && ends[k] == 0; ++k)
    others.add(tread_mm(wall, k));
  if (others.steps < 2) return false;
  // A flange or a groove has a second edge, so the widest other step is ignored, unless there are
  // too few steps.
  return tread > kFeatureRatio * (others.steps < 4 ? others.first : others.second);
}

CutFlags corners_of(const PieceWalls& piece, const WallRings& wall, double least_tread_mm) {
  CutFlags ends(piece.size() + 1, 0);
  ends.front() = ends.back() = 1;
  for (std::size_t k = 1; k < piece.size(); ++k)
    if ((wall.radius[k] > 0.0) != (wall.radius[k - 1] > 0.0)) ends[k] = 1;
  CutFlags cut = ends;
  for (std::size_t k = 1; k < piece.size(); ++k)
    if (ends[k] == 0 && tread_mm(wall, k) >= least_tread_mm && is_feature(piece, wall, ends, k))
      cut[k] = 1;
  return cut;
}

}  // namespace

PieceWalls walls_of(const ClayStack& stack, RingRange range) {
  PieceWalls piece;
  WideQuanta clay = 0;
  for (std::size_t i = range.first; i <= range.last; ++i) {
    step_of_loop();
    const Ring& ring = stack.rings()[i];
    piece.level.push_back(level_mm(stack, i));
    add_ring(piece.outer, ring.outer2);
    add_ring(piece.bore, ring.inner2);
    clay += ring.volume();
  }
  const bool top = range.last + 1 == stack.size();
  piece.level.push_back(level_mm(stack, range.last + 1));
  piece.ring_height_mm = stack.ring_height_mm();
  piece.top_height_mm = stack.ring_height_mm() + (top ? stack.crown_height_mm() : 0.0);
  piece.clay_over_pi = mm2_from_quanta(clay + (top ? stack.crown() : 0)) * stack.ring_height_mm();
  piece.least_step_mm =
      std::ldexp(*std::max_element(piece.outer.radius.begin(), piece.outer.radius.end()), -20);
  piece.stands_on_piece = range.first > 0;
  piece.carries_piece = !top;
  return piece;
}

Cuts corners_of(const PieceWalls& piece, double least_tread_mm) {
  return {corners_of(piece, piece.outer, least_tread_mm),
          corners_of(piece, piece.bore, least_tread_mm)};
}

}  // namespace clay::solid::inline smoothing
