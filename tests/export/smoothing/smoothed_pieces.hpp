#pragma once
// Smoothed profiles taken apart, beside the steps that they were made from.

#include "claystack/export/smoothing.hpp"
#include "tests/export/smoothing/smoothing_oracles.hpp"
#include "tests/export/smoothing/smoothing_stacks.hpp"

#include <cstddef>
#include <utility>
#include <vector>

namespace clay::solid::shapes {

using oracles::Real;

inline SmoothedProfile smooth(const ClayStack& stack, const SmoothingOptions& options) {
  return smooth_profile_of(stack, options).value();
}

/// One piece in the steps of a stack and in the smoothed section.
struct PieceOfBoth {
  std::size_t first, last;
  std::vector<Real> levels;
  oracles::Walls steps, smooth;
};

inline std::vector<PieceOfBoth> pieces_of_both(const ClayStack& stack,
                                               const SmoothedProfile& smoothed) {
  std::vector<PieceOfBoth> pieces;
  for (std::size_t k = 0; k < smoothed.section.shapes.size(); ++k) {
    const auto& [topology, first, last, cavities] = smoothed.section.shapes[k];
    pieces.push_back({first, last, oracles::levels_of(stack, first, last),
                      oracles::steps_of(stack, first, last),
                      oracles::walls_of(smoothed.section.profile.pieces[k])});
  }
  return pieces;
}

/// Volume over pi of a whole line.
inline Real swept(const oracles::Line& line) {
  return oracles::swept_over_pi(line, line.front().y, line.back().y);
}

/// Level treads of the outer wall, as (height, width).
inline std::vector<std::pair<double, double>> treads(const oracles::Line& line) {
  std::vector<std::pair<double, double>> found;
  for (std::size_t i = 0; i + 1 < line.size(); ++i)
    if (line[i].y == line[i + 1].y)
      found.emplace_back(static_cast<double>(line[i].y),
                         static_cast<double>(line[i + 1].rho - line[i].rho));
  return found;
}

}  // namespace clay::solid::shapes
