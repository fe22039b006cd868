#pragma once
#include "claystack/export/smoothing.hpp"
#include "export/smoothing/wall_guard.hpp"

namespace clay::solid::inline smoothing {

/// Rounds both edges of the lip by arcs that touch the top and the wall (or a bend of the wall).
/// The chords are within `tolerance_mm` of the arcs. The radius is smaller than requested if the
/// arcs of inside and outside would meet: in a straight wall half its thickness, more in a lip that
/// is narrower than the wall below it. An edge without width stays, with a radius of 0.
struct FilletedLip {
  WallLines lines;
  double radius_mm = 0.0;  ///< radius as made
};
[[nodiscard]] FilletedLip with_lip_fillet(const WallLines& lines, double radius_mm,
                                          double tolerance_mm);

/// `line` rises, with the clay at smaller radii, and ends at an edge. Replaces its upper end by an
/// arc that touches the wall (or a bend of it) and the level of the end.
struct RoundedEdge {
  Polygon line;
  double touch_rho = 0.0;  ///< distance from the axis at which the arc touches the level
};
[[nodiscard]] RoundedEdge with_rounded_edge(const Polygon& line, double radius_mm,
                                            double tolerance_mm);

/// Half the height of the last run: a larger arc could reach the step below it.
[[nodiscard]] double largest_fillet_mm(const PieceWalls& piece, const Cuts& cuts);

}  // namespace clay::solid::inline smoothing
