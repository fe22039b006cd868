#pragma once
// The two walls of a piece, ring by ring, and the corners that smoothing keeps.

#include "export/section/stack_section.hpp"

#include <cstddef>
#include <vector>

namespace clay::solid::inline smoothing {

/// One wall of a piece, ring by ring from the bottom.
struct WallRings {
  std::vector<double> radius;  ///< [mm]; 0 without a bore
  std::vector<double> square;  ///< square of the radius [mm^2]
};

/// The top ring of the stack and the crown count as one taller ring.
struct PieceWalls {
  std::vector<double> level;  ///< [mm] ring i spans level[i] to level[i + 1]
  double ring_height_mm = 0.0;
  double top_height_mm = 0.0;  ///< height of the last ring
  WallRings outer, bore;
  double clay_over_pi = 0.0;  ///< counted volume / pi [mm^3]
  double least_step_mm =
      0.0;  ///< narrower treads cannot be represented in float32: they are never cut
  bool stands_on_piece = false;  ///< another piece ends at its foot,
  bool carries_piece = false;    ///< or begins at its top

  [[nodiscard]] std::size_t size() const noexcept { return outer.radius.size(); }
  [[nodiscard]] double height_mm(std::size_t ring) const noexcept {
    return ring + 1 < size() ? ring_height_mm : top_height_mm;
  }
};
[[nodiscard]] PieceWalls walls_of(const ClayStack& stack, RingRange piece);

/// A flag for each interface of a piece: [k] is the level below ring k. Foot and lip, [0] and
/// [size()], are always set. A cut wall keeps the level tread between its two radii; between cuts
/// it is smoothed. If all interfaces are cut, the wall consists of the steps.
using CutFlags = std::vector<char>;

struct Cuts {
  CutFlags outer, bore;
};

/// Corners that smoothing must keep: foot, lip, the ends of a bore (in the bore only), and
/// features. A feature is a tread of at least half a ring's height that is over six times as wide
/// as the second widest of the three steps below it and the three above (the widest, if there are
/// fewer than four steps): a ledge, a gallery, or a flange, whose other edge may be the widest
/// step. Even slopes have no such tread, and noise hardly ever; a wall of fewer than four rings is
/// too short to show one. A tread narrower than `least_tread_mm` is no feature.
[[nodiscard]] Cuts corners_of(const PieceWalls& piece, double least_tread_mm);

/// Calls `visit(first, end)` for every run of rings between two cuts.
template <class Visit>
void for_each_run(const CutFlags& cut, Visit visit) {
  for (std::size_t first = 0, end = 1; end < cut.size(); ++end)
    if (cut[end] != 0) visit(first, end), first = end;
}

}  // namespace clay::solid::inline smoothing
