#pragma once
#include "export/smoothing/piece_walls.hpp"

#include <cstddef>
#include <vector>

namespace clay::solid::inline smoothing {

/// An interface that became a cut because a ring beside it would have overshot.
struct OvershootCut {
  std::size_t interface = 0;
  double overshoot_mm = 0.0;
};

struct ExactWall {
  Polygon line;
  double overshoot_mm = 0.0;     ///< largest overshoot that remains
  double extrapolated_mm = 0.0;  ///< the same without extrapolated rings
  double largest_error = 0.0;    ///< largest relative error of a ring's R^2 h
  std::vector<OvershootCut> cut;
};

/// A wall from the bottom up in which each ring keeps its own R^2 h. It has four frusta per ring
/// along the derivative of a monotone cubic through the cumulative volume. The values at the
/// interfaces are weighted harmonic means of the squared radii beside them (Fritsch and Butland,
/// SIAM J. Sci. Stat. Comput. 5(2) 1984), so that no radius reaches 0; a bulge s 4t(1 - t), with s
/// from one quadratic, then makes the frusta exact. At the end of a run the wall continues with the
/// smaller of its last two steps; where another piece begins, it continues straight. Overshoot is
/// the distance by which a ring's wall leaves the radii of the ring and its two neighbours (at the
/// end of a run, of the extrapolated ring). If it exceeds the limit, the wider of the ring's two
/// steps becomes a cut: it is flagged in `cut` and reported in the result.
[[nodiscard]] ExactWall exact_wall(const PieceWalls& piece, const WallRings& wall, CutFlags& cut,
                                   double overshoot_limit_mm);

}  // namespace clay::solid::inline smoothing
