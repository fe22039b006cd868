#pragma once
// Random stacks that smoothing finds hard, and options to smooth them with.

#include "claystack/export/smoothing.hpp"
#include "tests/engine/clay/stack_samples.hpp"
#include "tests/export/solid/shapes.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

namespace clay::solid::shapes {

/// Walls that wander, with now and then a jump, a thin stretch, a floor, a lid or a gap between
/// pieces; with a crown or without.
inline ClayStack wandering(std::mt19937_64& random, std::size_t count, double h) {
  const auto chance = [&](double p) { return samples::uniform(random) < p; };
  const auto step = [&](double size) { return size * (samples::uniform(random) - 0.5); };
  std::vector<Radii> radii;
  double outer = 40.0, slope = 0.0, wall = 5.0;
  bool bore = chance(0.5);
  for (std::size_t i = 0; i < count; ++i) {
    slope = std::clamp(slope + step(0.3), -1.2, 1.2);
    outer += slope * h + (chance(0.04) ? step(24.0) : 0.0);
    outer = std::clamp(outer, 15.0, 90.0);
    wall = std::clamp(wall + step(0.4) + (chance(0.04) ? step(10.0) : 0.0), 0.3, 12.0);
    if (chance(0.03)) wall = 0.1;
    if (chance(0.04)) bore = !bore;
    radii.push_back({outer, bore ? outer - wall : 0.0});
  }
  const ClayStack stack = stack_of(h, radii);
  const std::vector<Ring> rings(stack.rings().begin(), stack.rings().end());
  const WideQuanta crown =
      rings.back().volume() * static_cast<Quanta>(random() % 3) / WideQuanta{3};
  return ClayStack::from_rings(h, rings, crown).value();
}

/// Of the hard ones, of those with a step of tens of mm at every ring, and of tiny ones.
inline ClayStack hard_stack(std::size_t most) {
  auto random = *samples::random_engine();
  const auto count = *rc::gen::inRange<std::size_t>(1, most);
  const double h = *rc::gen::element(0.2, 0.7, 3.0);
  switch (*rc::gen::inRange(0, 4)) {
    case 0:
      return samples::stack(random, std::min<std::size_t>(count, 40), h);
    case 1:
      return *any_stack();
    default:
      return wandering(random, count, h);
  }
}

inline SmoothingOptions options_for(Smoothing mode, double tolerance_mm = 0.02) {
  SmoothingOptions options;
  options.mode = mode;
  options.tolerance_mm = tolerance_mm;
  return options;
}

/// The permitted thinning by `fair` of walls at the limit [mm], if the limit is the thinnest wall
/// of the piece.
inline double wall_slack_mm(const SmoothingOptions& options, double limit_mm) {
  const bool thick = limit_mm > 10.0 * options.tolerance_mm;
  return options.mode == Smoothing::fair && !options.min_wall_mm && thick
             ? 1e-3 * options.tolerance_mm
             : 0.0;
}

/// Maximum displacement of a wall by `fair` to keep the volume [mm].
inline double allowed_move_mm(const ClayStack& stack, const SmoothingOptions& options) {
  return std::max(options.tolerance_mm, 0.01 * stack.ring_height_mm());
}

inline SmoothingOptions any_options() {
  SmoothingOptions options = options_for(*rc::gen::element(Smoothing::fair, Smoothing::exact),
                                         *rc::gen::element(1e-4, 0.02, 0.5));
  if (options.mode == Smoothing::fair)
    options.smooth_length_mm = *rc::gen::element(0.0, 0.5, 9.0, 60.0);
  if (*rc::gen::inRange(0, 2) == 1) options.min_wall_mm = *rc::gen::element(0.0, 1.0, 4.0, 1000.0);
  return options;
}

}  // namespace clay::solid::shapes
