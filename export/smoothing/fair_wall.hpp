#pragma once
// Straight from middle to middle, and scaled to the volume of the rings.

#include "claystack/export/section.hpp"
#include "export/smoothing/piece_walls.hpp"

#include <vector>

namespace clay::solid::inline smoothing {

/// A wall from the bottom up: within every run straight to the middle of its first ring, from
/// middle to middle, and straight to its end, so that at each height the radius is a mean of two
/// rings' own, with the same weights for both walls. Middles that the line can spare within their
/// ring's tolerance are left out (`simplified`).
[[nodiscard]] Polygon fair_wall(const PieceWalls& piece, const WallRings& wall, const CutFlags& cut,
                                const std::vector<double>& tolerances_mm);

/// The steps as they are.
[[nodiscard]] Polygon stepped_wall(const PieceWalls& piece, const WallRings& wall);

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
