#pragma once
// Lines between the middles of rings, or faired, scaled to the volume of the rings.

#include "claystack/export/section.hpp"
#include "export/smoothing/piece_walls.hpp"

#include <vector>

namespace clay::solid::inline smoothing {

/// Limits of `fair_wall` at each ring.
struct FairRings {
  double tolerance_mm = 0.0;          ///< the largest of `tolerances_mm`
  std::vector<double> tolerances_mm;  ///< of the simplification
  std::vector<double> lengths_mm;     ///< of the fairing; 0: chords; empty: chords everywhere
};

/// A place where fairing moved a wall from the radius of a ring.
struct FairedMove {
  double mm = 0.0;     ///< along the radius
  double at_mm = 0.0;  ///< height
};

struct FairWall {
  Polygon line;
  FairedMove most;  ///< the largest
};

/// A wall from the bottom up. In every run it is straight to the middle of the first ring, from
/// middle to middle, and straight to the end; at each height the radius is a mean of two rings'
/// radii, with the same weights for both walls. Middles within their ring's tolerance of the line
/// without them are omitted (`simplified`).
///
/// Where rings have a length, stretches of at least kLeastFairedRings of them follow a FairedCurve
/// instead. An eighth of the tolerance is for its chords (kChordShare), the rest for their
/// simplification. A curve that would halve the smallest radius of its stretch is not used.
[[nodiscard]] FairWall fair_wall(const PieceWalls& piece, const WallRings& wall,
                                 const CutFlags& cut, const FairRings& rings);

/// The unsmoothed steps.
[[nodiscard]] Polygon stepped_wall(const PieceWalls& piece, const WallRings& wall);

/// Integral of rho^2 dy along a line from the bottom up [mm^3]: the volume of revolution divided by
/// pi.
[[nodiscard]] double swept_over_pi(const Polygon& line) noexcept;

/// The relative change, times its weight, of each radius of `line` that gives the line the volume
/// `wanted_over_pi` [mm^3]; solves the quadratic directly. 0 if all weights are 0.
[[nodiscard]] double scale_for(const Polygon& line, const std::vector<double>& weights,
                               double wanted_over_pi) noexcept;

/// Scales every rho by 1 + weight share. Returns the largest displacement [mm].
double scale(Polygon& line, const std::vector<double>& weights, double share) noexcept;

}  // namespace clay::solid::inline smoothing
