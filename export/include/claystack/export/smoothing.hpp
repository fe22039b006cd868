#pragma once
// From the steps of a stack to the walls that a potter sees, without losing clay.

#include "claystack/core/result.hpp"
#include "claystack/engine/clay.hpp"
#include "claystack/export/section.hpp"

#include <optional>
#include <string_view>
#include <vector>

namespace clay::solid::inline smoothing {

enum class Smoothing {
  none,   ///< the steps as they are
  fair,   ///< chords from middle to middle; every piece keeps its volume
  exact,  ///< every ring keeps its volume, outer cylinder and bore each
};
/// "none", "fair" or "exact".
[[nodiscard]] std::string_view name_of(Smoothing smoothing) noexcept;

struct SmoothingOptions {
  Smoothing mode = Smoothing::fair;
  /// How far from the walls that `fair` makes they may be simplified, both walls together [mm].
  double tolerance_mm = 0.02;
  /// No place gets thinner than this or than it was, whichever is less [mm]. Not given: the
  /// least wall that the piece has as steps.
  std::optional<double> min_wall_mm;
  /// Radius of the arcs that round both edges of the lip [mm]; `fair` only. Capped at half the
  /// lip's width, and at half the height of what stands above the last corner of its walls.
  double lip_fillet_mm = 0.0;
  /// `exact`: how far a radius may leave those of its ring and the two beside it [mm]. Not given:
  /// the tolerance.
  std::optional<double> overshoot_limit_mm;
};

/// What smoothing gave way to.
enum class KeptFor {
  wall,         ///< the wall would have been thinner than it may
  overshoot,    ///< a radius would have overshot
  volume,       ///< giving back what a jump's chords cost would have moved the walls too far
  certificate,  ///< the section would not have been a simple polygon
};
/// "wall", "overshoot", "volume" or "certificate".
[[nodiscard]] std::string_view name_of(KeptFor reason) noexcept;

/// Where steps stayed as they are. They lie at the levels of the rings from `from_mm` to `to_mm`,
/// which are the same height for a single step.
struct KeptSteps {
  double from_mm = 0.0;
  double to_mm = 0.0;
  KeptFor reason = KeptFor::wall;
  /// The least wall (or largest overshoot, or move of the walls) that smoothing would have left.
  double smoothed_mm = 0.0;
  double kept_mm = 0.0;  ///< the wall there now, as far as it is not above the limit; 0 else
};

struct SmoothedProfile {
  StackProfile section;
  std::vector<KeptSteps> guard;  ///< by piece, reason and height
  /// How far radii leave those of the rings about them: in `fair`, the volume correction.
  double overshoot_mm = 0.0;
  /// Above 0 where `fair` had clay to take and found no walls clear of the limit to take it from:
  /// walls may be thinner than the guard promises by this much, solids by twice as much [mm].
  double taken_mm = 0.0;
  double lip_fillet_mm = 0.0;          ///< as made
  double volume_error_relative = 0.0;  ///< against the counted clay
  /// `exact`: of any ring's R^2 h or r^2 h, with the levels as double holds them: of 10^6 rings the
  /// upper ones lose digits of h to that.
  double max_ring_error_relative = 0.0;
};

/// The profile of a stack with smooth walls. Both modes work on runs of rings between cuts, which
/// are interfaces where the step stays: foot, lip, floors and lids, features (ledges, galleries,
/// flanges: treads several times wider than the steps around them), and wherever the guard wins.
///
/// fair   Walls run straight to the middle of the first ring of a run, from middle to middle, and
///        straight to its end; so the wall R - r is everywhere a mean of two rings' own. Points
///        within `tolerance_mm` / 2 of the line without them are left out. What both change is
///        given back by scaling the outer wall, so that every piece holds its counted clay. Where
///        clay is to be taken, it is taken where walls are clear of the limit. If that would
///        move a wall by more than the tolerance and a hundredth of a ring's height, the jumps that
///        cost most become cuts.
/// exact  Walls follow a monotone interpolant of each wall's cumulative volume; frusta within the
///        rings are corrected so that every ring keeps R^2 h and r^2 h. A jump forces overshoot;
///        above the limit it becomes a cut.
///
/// Guard, both modes: for every ring the distance from either wall at its heights to the other
/// wall (twice the radius where there is no bore) is no less than it was, or than `min_wall_mm`,
/// whichever is less. Measured exactly, with a slack of 1e-9 for rounding. Where it would fail,
/// first the simplification and then the smoothing is left out. Treads below 2^-20 of the largest
/// radius, which float32 cannot hold, never become cuts: walls may lose less than one of them. The
/// lip fillet is cut afterwards, and rounds what it must. Every piece is certified; one that cannot
/// be keeps its steps.
///
/// Errors: as `profile_of`; `bad_input` for options out of range and for a lip fillet in `exact`,
/// which takes from a ring what `exact` promises to it.
Result<SmoothedProfile> smooth_profile_of(const ClayStack& stack,
                                          const SmoothingOptions& options = {});

}  // namespace clay::solid::inline smoothing
