#pragma once
// What the guard lets through and when it lets go. Sources: CHAI3D 3.3.0 has the small force and
// the rise over 2 s (there off by default) and 8 N as the Falcon's force; a hand left alone with
// a 0.1 kg handle and 5 N is at 0.5 m/s and 2.5 mm after 10 ms, at 1.6 m/s and 26 mm after the
// 32 ms of CHAI3D's watchdog: hence 10 ms. The rest is our judgement, and says so.

#include "claystack/falcon/out_of_range.hpp"

#include <tl/expected.hpp>

namespace clay::falcon {

/// What no setting may loosen.
inline constexpr double kMostForceN = 8.0;        ///< what the Falcon gives in all directions
inline constexpr double kLongestToZeroS = 0.010;  ///< from a fault to force 0
inline constexpr double kShortestStepS = 0.0002;  ///< a velocity is never divided by less
inline constexpr double kLongestStepS = 0.005;    ///< nor does a frame count for more

struct GuardSettings {
  /// Of the servo: a late tick gets no more rise than one on time. 0.1 to 2.5 ms; slower than
  /// 400 Hz, frames could not be told from stale ones in time.
  double period_s = 0.001;

  double force_limit_n = 5.0;   ///< most force, above 0 up to kMostForceN
  double slew_n_per_s = 500.0;  ///< fastest rise, 1 to 5000; falls are not held up. Our judgement

  double small_force_n = 0.2;  ///< to engage, less is wanted than this (CHAI3D); below the limit
  int small_force_ticks = 5;   ///< for so many ticks, 1 to 1000 (CHAI3D: more than 3)
  double ramp_s = 2.0;         ///< then the force grows to its whole, 0.1 to 60 s (CHAI3D)

  /// Age of the newest frame from which force fades: two periods or more. Our judgement.
  double stale_fade_s = 0.005;
  double stale_zero_s = 0.010;  ///< and from which it is 0: after the fade, to kLongestToZeroS
  double late_zero_s = 0.010;   ///< a tick so late sends 0: two periods to kLongestToZeroS
  double pause_s = 0.050;       ///< a longer gap in ticks or frames is a pause: re-engage. To 1 s

  /// Faster than a hand: such frames are dropped, 100 to 10 000 (2 m/s is 2 mm in a tick of 1 ms).
  double jump_mm_per_s = 2000.0;

  double clay_fade_s = 0.100;  ///< the same for the clay that the force was computed from: to 1 s
  double clay_zero_s = 0.150;  ///< after the fade, to 2 s

  double hot_force_n = 4.0;  ///< more than this warms the motors: above 0 to force_limit_n
  double hot_time_s = 10.0;  ///< so long it may last, 0.1 to 60
  double hot_fade_s = 1.0;   ///< then force fades within this, 0.05 to 10

  int not_finite_ticks = 3;  ///< ticks in a row with a NaN or infinity until SAFE, 1 to 10
  double safe_rest_s = 0.1;  ///< good frames before a SAFE that mends itself ends, 0.01 to 10
};

/// The first setting that is no number or out of its range, which other settings may bound.
[[nodiscard]] tl::expected<void, OutOfRange> check(const GuardSettings& settings) noexcept;

}  // namespace clay::falcon
