#pragma once
#include "export/smoothing/wall_guard.hpp"

namespace clay::solid::inline smoothing {

/// Rounds both edges of the lip by arcs that touch the top and the wall (or a bend of the wall).
/// The chords are within `tolerance_mm` of the arcs. The radius is at most that of
/// `largest_fillet`; it is smaller if the arcs of inclined walls would meet.
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

struct LargestFillet {
  double radius_mm = 0.0;
  FilletLimit limit = FilletLimit::none;  ///< what does not allow more
};
/// Half the width of the lip (half its radius if there is no bore), or half the height of the last
/// run below it, whichever is smaller.
[[nodiscard]] LargestFillet largest_fillet(const PieceWalls& piece, const Cuts& cuts,
                                           const WallLines& lines);

}  // namespace clay::solid::inline smoothing
