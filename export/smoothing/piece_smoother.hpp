#pragma once
#include "claystack/export/smoothing.hpp"
#include "export/smoothing/piece_walls.hpp"

#include <vector>

namespace clay::solid::inline smoothing {

struct SmoothedPiece {
  Polygon section;
  std::vector<KeptSteps> guard;
  double overshoot_mm = 0.0;
  double taken_mm = 0.0;
  double lip_fillet_mm = 0.0;
  double max_ring_error_relative = 0.0;
};

/// One piece as `smooth_profile_of` says, `fair` or `exact`. Only the topmost piece has a lip.
[[nodiscard]] SmoothedPiece smooth_piece(const PieceWalls& piece, const SmoothingOptions& options);

}  // namespace clay::solid::inline smoothing
