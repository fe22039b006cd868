#pragma once
// How stiff a wall can be that a sampled arm renders. A wall read once a period and held for the
// next is late, and what is late gives back more than it took; the arm's own damping has to eat
// the difference. Sources: J. E. Colgate, G. G. Schenkel, "Passivity of a class of sampled-data
// systems: application to haptic interfaces", J. Robotic Systems 14(1), 1997; E. I. Jury, "Theory
// and Application of the z-Transform Method", 1964 (the stability of a sampled loop).
//
// SI units throughout: m, s, kg, N. T = 1 / rate is the period, n the ticks of delay.

#include "claystack/falcon/out_of_range.hpp"

#include <tl/expected.hpp>

namespace clay::falcon {

/// What of an arm and its servo decides how stiff a wall may be.
struct SampledLoop {
  double rate_hz = 1000.0;
  double mass_kg = 0.25;          ///< m: of the handle, as the hand feels it
  double damping_ns_per_m = 2.0;  ///< b: of the arm itself, without the hand
  int delay_ticks = 1;            ///< n: periods between a reading and the force that answers it

  [[nodiscard]] double period_s() const noexcept { return 1.0 / rate_hz; }
};

/// Rates of 10 to 100 000 Hz, masses of 1 g to 100 kg, damping of 0 to 1000 N s/m, 0 to 8 ticks.
[[nodiscard]] tl::expected<void, OutOfRange> check(const SampledLoop& loop) noexcept;

/// A wall of the servo: a spring, and a damper on the difference of the last two readings.
struct VirtualWall {
  double stiffness_n_per_m = 0.0;  ///< K >= 0
  double damping_ns_per_m = 0.0;   ///< B, of either sign
};

/// Damping [N s/m] that an arm needs so that, whatever passive hand holds it, the wall gives no
/// energy away. Colgate and Schenkel's integral for this wall is a sum of cosines,
///
///   b > max over w of  K T/2 (1 + 2 cos wT + ... + 2 cos nwT) - B cos((n + 1) wT),
///
/// and K T/2 + |B| without delay, (2n + 1) K T/2 for a spring alone.
[[nodiscard]] double passive_damping(const SampledLoop& loop, const VirtualWall& wall) noexcept;
/// The same at one angle w T [rad], 0 to pi: what a motion of that frequency asks for.
[[nodiscard]] double passive_damping_at(const SampledLoop& loop, const VirtualWall& wall,
                                        double angle_rad) noexcept;

/// Stiffest spring [N/m] that is passive: 2b / ((2n + 1) T).
[[nodiscard]] double passive_stiffness(const SampledLoop& loop) noexcept;

/// Does the free arm come to rest against the wall, held there? By Jury's test of
///
///   z^(n+1) (z - 1)(z - p) + (K z + B (z - 1)/T)(c1 z + c0),    p = e^(-bT/m),
///
/// where (c1 z + c0) / ((z - 1)(z - p)) takes held force to position, exactly.
[[nodiscard]] bool is_stable(const SampledLoop& loop, const VirtualWall& wall) noexcept;

/// The border of the stable springs [N/m], to 1e-9 of it: stable below, not above. 0 when none is.
/// `wall_damping_ns_per_m` is B.
[[nodiscard]] double stable_stiffness(const SampledLoop& loop,
                                      double wall_damping_ns_per_m = 0.0) noexcept;

/// Most damping B [N s/m] that the servo may add to a spring before the loop is unstable; to 1e-9
/// of it.
[[nodiscard]] double stable_damping(const SampledLoop& loop, double stiffness_n_per_m) noexcept;

/// Stiffest contact that is let through: half of what is passive. The other half is for what the
/// theory leaves out: encoder steps, late ticks, a damping known to a factor.
[[nodiscard]] double accepted_stiffness(const SampledLoop& loop) noexcept;

/// Why a stiffness is refused, and the two ways out.
struct StiffnessTooHigh {
  double found_n_per_m;
  double highest_n_per_m;  ///< the accepted stiffness at this rate
  double lowest_rate_hz;   ///< the rate from which the stiffness found is accepted
};

/// Refuses what is above accepted_stiffness, and what is not a number.
[[nodiscard]] tl::expected<void, StiffnessTooHigh> check_stiffness(
    const SampledLoop& loop, double stiffness_n_per_m) noexcept;

}  // namespace clay::falcon
