#pragma once
#include "export/smoothing/wall_guard.hpp"

namespace clay::solid::inline smoothing {

/// Both edges of the lip rounded by arcs that touch the top and the wall (at a bend of the wall,
/// the bend), sampled so that no chord strays from its arc by more than `tolerance_mm`. The radius
/// is at most `largest_fillet_mm`; where arcs of leaning walls would still meet, less.
struct FilletedLip {
  WallLines lines;
  double radius_mm = 0.0;  ///< as made
};
[[nodiscard]] FilletedLip with_lip_fillet(const WallLines& lines, double radius_mm,
                                          double tolerance_mm);

/// Half the width of the lip (of a lip without a bore, half its radius), and half the height of
/// the last run below it.
[[nodiscard]] double largest_fillet_mm(const PieceWalls& piece, const Cuts& cuts,
                                       const WallLines& lines);

}  // namespace clay::solid::inline smoothing
