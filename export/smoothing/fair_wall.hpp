#pragma once
#include "export/smoothing/piece_walls.hpp"

namespace clay::solid::inline smoothing {

/// A wall from the bottom up: within every run straight to the middle of its first ring, from
/// middle to middle, and straight to its end, so that at each height the radius is a mean of two
/// rings' own, with the same weights for both walls. Middles that the line can spare within their
/// ring's tolerance are left out (`simplified`).
[[nodiscard]] Polygon fair_wall(const PieceWalls& piece, const WallRings& wall, const CutFlags& cut,
                                const std::vector<double>& tolerances_mm);

/// The steps as they are.
[[nodiscard]] Polygon stepped_wall(const PieceWalls& piece, const WallRings& wall);

}  // namespace clay::solid::inline smoothing
