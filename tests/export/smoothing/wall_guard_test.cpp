#include "export/smoothing/wall_guard.hpp"

#include "tests/export/smoothing/smoothing_oracles.hpp"
#include "tests/export/smoothing/smoothing_stacks.hpp"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

namespace clay::solid {
namespace {

using oracles::Real;

/// The least distance of two lines, without those of their edges that lie on the axis.
Real between(const Polygon& a, const Polygon& b) {
  const auto on_axis = [](const Polygon& line, std::size_t i) {
    return line[i].rho == 0.0 && line[i + 1].rho == 0.0;
  };
  const auto edge = [](const Polygon& line, std::size_t i) {
    return oracles::Edge{{line[i].rho, line[i].y}, {line[i + 1].rho, line[i + 1].y}};
  };
  Real least = 1e9L;
  for (std::size_t i = 0; i + 1 < a.size(); ++i)
    for (std::size_t k = 0; k + 1 < b.size(); ++k)
      if (!on_axis(a, i) && !on_axis(b, k))
        least = std::min(least, oracles::distance(edge(a, i), edge(b, k)));
  return least;
}

/// Tubes, so that no wall goes across the axis.
ClayStack any_tube() {
  std::vector<shapes::Radii> radii;
  for (int i = *rc::gen::inRange(1, 30); i > 0; --i) {
    const double bore = 20.0 + 0.1 * *rc::gen::inRange(0, 40);
    radii.push_back({bore + 5.0 + 0.1 * *rc::gen::inRange(0, 40), bore});
  }
  return shapes::stack_of(1.5, radii);
}

RC_GTEST_PROP(WallGauge, DecidesByTheLeastDistance, ()) {
  const ClayStack stack = any_tube();
  const PieceWalls piece = walls_of(stack, {0, stack.size() - 1});
  const WallLines lines = stepped_lines(piece);
  const auto least = static_cast<double>(between(lines.outer, lines.bore));
  const WallGauge gauge(piece, lines);
  RC_ASSERT(gauge.thinner_than(least + 1e-6));
  RC_ASSERT(!gauge.thinner_than(least - 1e-6));
  const RingFlags thin = gauge.rings_near_thin(least + 1e-6);
  RC_ASSERT(std::ranges::count(thin, 1) > 0);
  RC_ASSERT(std::ranges::count(gauge.rings_near_thin(least - 1e-6), 1) == 0);
  RC_ASSERT(std::abs(std::ranges::min(gauge.by_ring_mm(1e3, thin)) - least) < 1e-9);
}

RC_GTEST_PROP(OwnWalls, AreThoseOfAGaugeInAnyOrderOfQuestions, ()) {
  const ClayStack stack = any_tube();
  const PieceWalls piece = walls_of(stack, {0, stack.size() - 1});
  constexpr double kCapMm = 6.0;
  const std::vector<double> whole =
      WallGauge(piece, stepped_lines(piece)).by_ring_mm(kCapMm, RingFlags(piece.size(), 1));
  OwnWalls walls(piece, kCapMm);
  for (int question = 0; question < 3; ++question) {
    RingFlags rings(piece.size());
    for (char& flag : rings) flag = *rc::gen::inRange<char>(0, 2);
    const std::vector<double>& found = walls.by_ring_mm(rings);
    for (std::size_t i = 0; i < rings.size(); ++i)
      if (rings[i] != 0) RC_ASSERT(found[i] == whole[i]);
  }
}

}  // namespace
}  // namespace clay::solid
