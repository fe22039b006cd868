#pragma once
#include "export/smoothing/piece_walls.hpp"

#include <cstddef>
#include <vector>

namespace clay::solid::inline smoothing {

/// An interface that became a cut since a ring beside it would have overshot.
struct OvershootCut {
  std::size_t interface = 0;
  double overshoot_mm = 0.0;
};

struct ExactWall {
  Polygon line;
  double overshoot_mm = 0.0;   ///< the largest that is left
  double largest_error = 0.0;  ///< of a ring's R^2 h, relative
  std::vector<OvershootCut> cut;
};

/// A wall from the bottom up that leaves each ring its own R^2 h: four frusta a ring along the
/// derivative of a monotone cubic through the cumulative volume, whose values at the interfaces
/// are weighted harmonic means of the squared radii beside them (Fritsch and Butland, SIAM J. Sci.
/// Stat. Comput. 5(2) 1984), so that no radius reaches 0; a bulge s 4t(1 - t), s from one
/// quadratic, then makes the frusta exact. At the end of a run the wall goes on as the smaller of
/// its last two steps did; where another piece begins, straight.
///
/// Overshoot is how far a ring's wall leaves the radii of the ring and the two beside it (at the
/// end of a run, of the ring that would go on). Where it exceeds the limit the wider of the ring's
/// two steps is cut: flagged in `cut`, and told of in the result.
[[nodiscard]] ExactWall exact_wall(const PieceWalls& piece, const WallRings& wall, CutFlags& cut,
                                   double overshoot_limit_mm);

}  // namespace clay::solid::inline smoothing
