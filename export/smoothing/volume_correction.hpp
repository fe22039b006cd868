#pragma once
#include "claystack/export/section.hpp"

#include <vector>

namespace clay::solid::inline smoothing {

/// Integral of rho^2 dy along a line from the bottom up [mm^3]: the volume it sweeps, over pi.
[[nodiscard]] double swept_over_pi(const Polygon& line) noexcept;

/// The share of itself that each radius of `line` must gain (or lose) for the line to sweep
/// `wanted_over_pi` [mm^3], times its weight; the quadratic is solved as it stands. 0 where the
/// weights leave nothing to move.
[[nodiscard]] double scale_for(const Polygon& line, const std::vector<double>& weights,
                               double wanted_over_pi) noexcept;

/// rho (1 + weight share) for every point; the largest move [mm] is returned.
double scale(Polygon& line, const std::vector<double>& weights, double share) noexcept;

}  // namespace clay::solid::inline smoothing
