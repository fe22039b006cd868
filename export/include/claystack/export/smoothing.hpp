#pragma once
// Smooth walls from the steps of a stack, without losing clay.

#include "claystack/core/result.hpp"
#include "claystack/engine/clay.hpp"
#include "claystack/export/section.hpp"

#include <optional>
#include <string_view>
#include <vector>

namespace clay::solid::inline smoothing {

enum class Smoothing {
  none,   ///< the unsmoothed steps
  fair,   ///< chords from middle to middle, or faired; every piece keeps its volume
  exact,  ///< every ring keeps the volumes of its outer cylinder and of its bore
};
/// "none", "fair" or "exact".
[[nodiscard]] std::string_view name_of(Smoothing smoothing) noexcept;

struct SmoothingOptions {
  Smoothing mode = Smoothing::fair;
  /// `fair`: maximum simplification of the walls, both together [mm].
  double tolerance_mm = 0.02;
  /// Smoothing makes no place thinner than this [mm], unless the place was thinner before. For a
  /// flange the limit is this or the thinnest wall of the steps, whichever is smaller. Empty: the
  /// minimum wall of the piece's steps.
  std::optional<double> min_wall_mm;
  /// Radius of the arcs that round both edges of the lip [mm]; `fair` only. At most half the width
  /// of the lip, and half the height above the last corner of its walls.
  double lip_fillet_mm = 0.0;
  /// `exact`: maximum distance of a radius from the range of its ring and the two beside it [mm];
  /// beyond a cut, the ring there counts as a continuation of the wall (see `extrapolated_mm`).
  /// Empty: the tolerance.
  std::optional<double> overshoot_limit_mm;
  /// `fair`: walls have continuous curvature, and marks shorter along the height than this are
  /// smoothed away [mm]; at least two rings. 0: chords from middle to middle.
  double smooth_length_mm = 0.0;
};

/// The reason for keeping a step.
enum class KeptFor {
  wall,         ///< the wall would have been too thin
  overshoot,    ///< a radius would have overshot
  volume,       ///< compensating the volume of a jump's chords would have moved the walls too far
  certificate,  ///< the section would not have been a simple polygon
};
/// "wall", "overshoot", "volume" or "certificate".
[[nodiscard]] std::string_view name_of(KeptFor reason) noexcept;

/// A place where steps were kept, between the ring levels `from_mm` and `to_mm`; both are equal for
/// a single step.
struct KeptSteps {
  double from_mm = 0.0;
  double to_mm = 0.0;
  KeptFor reason = KeptFor::wall;
  /// The minimum wall (or maximum overshoot, or displacement of the walls) with smoothing.
  double smoothed_mm = 0.0;
  double kept_mm = 0.0;  ///< current wall, if it is not above the limit; otherwise 0
};

/// Heights where the wall guard made the length of the fairing shorter; 0: chords there [mm].
struct ShortenedFairing {
  double from_mm = 0.0;
  double to_mm = 0.0;
  double length_mm = 0.0;  ///< the least there
};

/// `fair` with a length.
struct FairingReport {
  double length_mm = 0.0;  ///< as used; 0: none
  double moved_mm = 0.0;   ///< largest distance of a wall from the radius of a ring, at its middle
  double moved_at_mm = 0.0;                 ///< height of that place
  std::vector<ShortenedFairing> shortened;  ///< by piece and height
};

/// Reason why the fillet of a lip has a smaller radius than requested.
enum class FilletLimit { none, lip_width, height_below };
/// "half the height between ... does not allow more"; empty for `none`.
[[nodiscard]] std::string_view reason_of(FilletLimit limit);

struct SmoothedProfile {
  StackProfile section;
  std::vector<KeptSteps> guard;  ///< places with kept steps, by piece, reason and height
  /// Maximum distance of radii from those of the neighbouring rings; in `fair`, due to the volume
  /// correction: at most the tolerance or 1/100 of a ring's height, unless the outer wall also gets
  /// the clay of a lip fillet. In `exact` at most the limit, or 2^-20 of the largest radius if that
  /// is more.
  double overshoot_mm = 0.0;
  /// `exact`: the same where walls continue in their direction at foot, lip and cuts: there a
  /// radius may lie beyond those of its ring and of the two beside it by up to the smaller of the
  /// last two steps (outward, by half of it).
  double extrapolated_mm = 0.0;
  /// Above 0 if `fair` had to remove clay and found no walls clear of the limit: then walls may be
  /// this much thinner than the guard promises, solids twice as much [mm].
  double taken_mm = 0.0;
  double lip_fillet_asked_mm = 0.0;  ///< radius
  /// As made, before a set-back for glaze: requested, or as `lip_fillet_limit` allows.
  double lip_fillet_mm = 0.0;
  FilletLimit lip_fillet_limit = FilletLimit::none;
  double volume_error_relative = 0.0;  ///< relative to the counted clay
  /// `exact`: maximum relative error of a ring's R^2 h or r^2 h, with levels in double precision;
  /// in a stack of 10^6 rings, the upper ones lose digits of h.
  double max_ring_error_relative = 0.0;
  FairingReport fairing;  ///< before the volume correction, which `overshoot_mm` bounds
};

/// The profile of a stack with smooth walls. Both modes work on runs of rings between cuts, which
/// are interfaces where the step remains: foot, lip, floors and lids, features (ledges, galleries,
/// flanges: treads several times wider than the steps around them, and in `fair` no narrower than
/// the tolerance and 1/16 of `smooth_length_mm`), and wherever the guard requires it.
///
/// fair   Walls run straight to the middle of the first ring of a run, from middle to middle, and
///        straight to its end; so where neither wall is cut, R - r is a mean of two rings' walls.
///        Beside a cut of one wall (a floor, a ledge), that wall has the radius of its ring, and
///        R - r differs from the ring's by at most half a step of the other wall. Points within
///        `tolerance_mm` / 2 of the line without them are omitted. The volume that both
///        change is restored by scaling the outer wall, so that every piece holds its counted clay.
///        Clay is removed only where walls are clear of the limit. If that would move a wall by
///        more than the tolerance and a hundredth of a ring's height, the jumps that change the
///        volume most become cuts.
///        With `smooth_length_mm` l, runs of at least four rings follow a curve of continuous
///        curvature instead: the cubic spline u of the height that minimises the sum over the rings
///        of h (u - R)^2 plus the integral of (l / 2 pi)^6 (d^3 u / dy^3)^2. A ripple of wavelength
///        l keeps half of its height, and a quadratic function of the height stays. Within l of the
///        end of a run, l is the distance to it, so that corners keep their place.
/// exact  Walls follow a monotone interpolant of each wall's cumulative volume; frusta within the
///        rings are corrected so that every ring keeps R^2 h and r^2 h. A jump forces overshoot;
///        above the limit it becomes a cut.
///
/// Guard, both modes: for every ring the distance from either wall at its heights to the other
/// wall (twice the radius where there is no bore) is at least what it was, or `min_wall_mm`,
/// whichever is smaller. Measured exactly, with a slack of 1e-9 for rounding. Clay between two
/// places of one wall (a flange, a ledge, the edge of a lip), by the definition of `min_wall`, does
/// not become thinner than `min_wall_mm` or every wall of the steps, whichever is smaller. Where
/// either would fail, first the simplification (and the fairing, its length halved each time) and
/// then the smoothing is undone. The fairing is also undone, for chords, where it alone makes clay
/// thinner than a `min_wall_mm` that chords keep, or else than half of their minimum. Treads below
/// 2^-20 of the largest radius, which float32 cannot hold, never become cuts: walls may lose less
/// than one of them. The lip fillet is applied afterwards and may thin the lip. Every piece is
/// certified; a piece that fails gets chords, then less simplification, and keeps its steps last.
///
/// Errors: as `profile_of`; `bad_input` for options out of range and for a lip fillet in `exact`,
/// which removes clay that `exact` promises to a ring.
Result<SmoothedProfile> smooth_profile_of(const ClayStack& stack,
                                          const SmoothingOptions& options = {});

// ---- finish --------------------------------------------------------------------------
// The work on the leather-hard pot: cut a foot, round the corner of the floor, leave room for the
// glaze. All lengths are those of the solid as written.

/// A ring on which the pot stands. Inside it the foot is cut away to the depth, and outside it too
/// if `diameter_mm` is set.
struct FootRing {
  double width_mm = 0.0;
  double depth_mm = 0.0;
  std::optional<double> diameter_mm;  ///< outside; empty: that of the pot's foot
};

struct Finish {
  std::optional<FootRing> foot;
  double floor_fillet_mm = 0.0;  ///< radius of the arc where the wall meets the floor inside
  double glaze_mm = 0.0;  ///< every face but the foot is set back by the thickness of the glaze

  [[nodiscard]] bool asked() const noexcept {
    return foot || floor_fillet_mm > 0.0 || glaze_mm > 0.0;
  }
};

/// The clay that each part of the finish removed or added [mm^3]: the differences of the volumes of
/// the sections before and after it.
struct FinishLedger {
  double foot_trimmed_mm3 = 0.0;
  double glaze_trimmed_mm3 = 0.0;
  double floor_added_mm3 = 0.0;

  [[nodiscard]] bool any() const noexcept { return trimmed_mm3() != 0.0 || floor_added_mm3 != 0.0; }
  [[nodiscard]] double trimmed_mm3() const noexcept { return foot_trimmed_mm3 + glaze_trimmed_mm3; }
};

struct FinishedProfile {
  Profile profile;
  FinishLedger ledger;
};

/// Sets the faces back, fills the corner of the floor, and cuts the foot, in this order. Arcs are
/// chords within `tolerance_mm`. Errors: `bad_input` for lengths that are negative or no numbers, a
/// profile of several pieces, a ring that does not fit the foot, a foot without clay above it, a
/// fillet wider than the floor; `unsound`, with the place, if the set-back leaves a wall thinner
/// than `min_wall_mm` or none at all, or if the foot leaves one thinner than `min_wall_mm` and than
/// the thinnest before, with the allowance of `WallLimit`.
Result<FinishedProfile> finished(const Profile& profile, const Finish& finish,
                                 std::optional<double> min_wall_mm, double tolerance_mm);

}  // namespace clay::solid::inline smoothing
