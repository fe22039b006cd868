#pragma once
// One piece with smooth walls: smoothed, measured by the guards, and smoothed less where they
// require it, until walls and volume are right.

#include "claystack/export/smoothing.hpp"
#include "export/smoothing/piece_walls.hpp"

#include <vector>

namespace clay::solid::inline smoothing {

/// As in SmoothedProfile, for one piece.
struct SmoothedPiece {
  Polygon section;
  std::vector<KeptSteps> guard;
  double overshoot_mm = 0.0;
  double extrapolated_mm = 0.0;
  double taken_mm = 0.0;
  double lip_fillet_mm = 0.0;
  FilletLimit lip_fillet_limit = FilletLimit::none;
  double max_ring_error_relative = 0.0;
  FairingReport fairing;
};

/// `fair` or `exact`. Only the topmost piece has a lip.
[[nodiscard]] SmoothedPiece smooth_piece(const PieceWalls& piece, const SmoothingOptions& options);

}  // namespace clay::solid::inline smoothing
