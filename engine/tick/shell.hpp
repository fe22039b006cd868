#pragma once
// Response of a wall to a tool on one side of it: a plastic shell, by limit analysis.

#include "claystack/engine/clay.hpp"
#include "engine/clay/packs.hpp"
#include "engine/tick/band.hpp"
#include "engine/tick/wall_radii.hpp"

#include <cstddef>
#include <span>

namespace clay {

/// The largest distance from a band at which a shell bends: bounds the work of a tick for any pot.
inline constexpr double kLongestShellMm = 35.0;

/// A motion that is slower than this has no direction: clay flows to both sides of it.
inline constexpr double kSlowMmS = 5.0;

/// The cubic from (0, 0) to (1, 1) with slope 0 at both ends.
template <class Number>
[[nodiscard]] CLAYSTACK_INLINE inline Number smooth(Number t) noexcept {
  return t * t * (3.0f - 2.0f * t);
}

/// Motion of the wall about a band: u(x) = share * give * tent(x), x the distance from the peak:
///
///     below  trail_below * smooth(1 - x / below_mm)
///     above  trail_above * smooth(1 - turn x / above_mm), and for turn <= 0: 1 - turn x / above_mm
///
/// Near the peak the two trails blend.
struct Shell {
  double share = 0.0;  ///< part of the give by which the wall moves instead of being squeezed
  double below_mm = 1.0, above_mm = 1.0;        ///< distances at which the wall is at rest again
  double turn = 1.0;                            ///< below 1 near the rim, which turns with the wall
  double trail_below = 1.0, trail_above = 1.0;  ///< less than 1 behind the moving tool
  double wall_mm = 1.0;                         ///< at the peak
  double foot_mm = -1e300;                      ///< height at which the wall stands on solid clay
  double root_mm = 1.0;                         ///< height above the foot that solid clay holds

  /// Less than 1 where the solid clay below holds the wall.
  [[nodiscard]] double hold(double up_mm) const noexcept {
    const double t = (up_mm - foot_mm) / root_mm;
    return t > 0.0 ? (t < 1.0 ? smooth(t) : 1.0) : 0.0;
  }
};

/// A wall moves less near the solid clay that it stands on: reduces `by_mm` from ring `first` on.
void hold_foot(const Shell& shell, double ring_height_mm, std::size_t first,
               std::span<float> by_mm) noexcept;

/// The part of a shell's motion that a ring follows: 0 if it is solid or nearly so (r < 0.2 R), as
/// it has no thin hoops then; 1 from r = 0.4 R on. `bore2`: (r / R)^2.
template <class Number>
[[nodiscard]] CLAYSTACK_INLINE inline Number pliancy(Number bore2) noexcept {
  constexpr float kStiff = 0.04f, kThin = 0.15625f;
  const Number fade = (bore2 - kStiff) * (1.0f / (kThin - kStiff));
  const Number positive = fade > 0.0f ? fade : Number{};
  return positive < 1.0f ? positive : Number{} + 1.0f;
}
[[nodiscard]] inline double pliancy(const Ring& ring) noexcept {
  return pliancy(static_cast<double>(ring.inner2) / static_cast<double>(ring.outer2));
}

/// Limit analysis of a plastic cylinder under a ring load (Tresca, hinge circles; moment M0 =
/// sigma w^2 / 4 and hoop force N0 = sigma w per mm). The mechanism of least power has the length
/// L = sqrt(R w); near the rim it turns, near the floor it is clamped. Its load Q_s, and that of a
/// punch that squeezes the clay aside, Q_i = (2 + pi) / 2 sigma c, are two yielding mechanisms in
/// series under one force, each with a rate ~ (Q / Q_k)^n: hence the share. At these speeds, upward
/// and into the wall, the wall behind the moving tool stays in place.
[[nodiscard]] Shell shell_at(const ClayStack& stack, WallRadii& walls, const Band& band,
                             double min_wall_mm, double upward_mm_s, double into_mm_s) noexcept;

}  // namespace clay
