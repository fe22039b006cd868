#pragma once
#include "claystack/falcon/device.hpp"

#include <cstdint>
#include <glm/vec3.hpp>
#include <memory>
#include <optional>
#include <tl/expected.hpp>

namespace clay::falcon::inline safety {

// ---- sampled bound -------------------------------------------------------------------
// The stiffness of a wall that a sampled arm can render. A wall that is read once per period and
// held for the next responds late, and so returns more energy than it absorbed; the arm's damping
// must dissipate the difference. Sources: J. E. Colgate, G. G. Schenkel, "Passivity of a class of
// sampled-data systems: application to haptic interfaces", J. Robotic Systems 14(1), 1997; E. I.
// Jury, "Theory and Application of the z-Transform Method", 1964 (the stability of a sampled loop).
//
// Units as everywhere in falcon: mm, s, N, and so mJ = N mm. T = 1 / rate is the period, n the
// ticks of delay.

/// The longest delay [ticks] of a SampledLoop.
inline constexpr int kMostDelayTicks = 8;

/// The properties of an arm and its servo that limit the stiffness of a wall.
struct SampledLoop {
  double rate_hz = 1000.0;
  double mass_kg = 0.25;             ///< m: of the handle, as the hand feels it
  double damping_ns_per_mm = 0.002;  ///< b: of the arm itself, without the hand
  int delay_ticks = 1;               ///< n: periods between a reading and the force that answers it

  [[nodiscard]] double period_s() const noexcept { return 1.0 / rate_hz; }
  /// The mass as force per acceleration [N s^2/mm]: the only conversion of units in falcon.
  [[nodiscard]] double inertia_ns2_per_mm() const noexcept { return 1e-3 * mass_kg; }
};

/// Rates of 10 to 100 000 Hz, masses of 1 g to 100 kg, damping of 0 to 1 N s/mm, 0 to
/// kMostDelayTicks ticks.
[[nodiscard]] tl::expected<void, OutOfRange> check(const SampledLoop& loop) noexcept;

/// A wall of the servo: a spring, and a damper on the difference of the last two readings.
struct VirtualWall {
  double stiffness_n_per_mm = 0.0;  ///< K >= 0
  double damping_ns_per_mm = 0.0;   ///< B, of either sign
};

/// Damping [N s/mm] that an arm needs so that the wall is passive for every passive hand. Colgate
/// and Schenkel's integral for this wall is a sum of cosines,
///
///   b > max over w of  K T/2 (1 + 2 cos wT + ... + 2 cos nwT) - B cos((n + 1) wT),
///
/// and K T/2 + |B| without delay, (2n + 1) K T/2 for a spring alone.
[[nodiscard]] double passive_damping(const SampledLoop& loop, const VirtualWall& wall) noexcept;
/// The same at one angle w T [rad], 0 to pi: the damping required at that frequency.
[[nodiscard]] double passive_damping_at(const SampledLoop& loop, const VirtualWall& wall,
                                        double angle_rad) noexcept;

/// Stiffest spring [N/mm] that is passive: 2b / ((2n + 1) T).
[[nodiscard]] double passive_stiffness(const SampledLoop& loop) noexcept;

/// True if the free arm comes to rest against a two-sided wall. By Jury's test of
///
///   z^(n+1) (z - 1)(z - p) + (K z + B (z - 1)/T)(c1 z + c0),    p = e^(-bT/m),
///
/// where (c1 z + c0) / ((z - 1)(z - p)) is the exact transfer function from held force to position.
[[nodiscard]] bool is_stable(const SampledLoop& loop, const VirtualWall& wall) noexcept;

/// The border of the stable springs [N/mm], to 1e-9 of it: stable below, not above. 0 if none is.
/// `wall_damping_ns_per_mm` is B.
[[nodiscard]] double stable_stiffness(const SampledLoop& loop,
                                      double wall_damping_ns_per_mm = 0.0) noexcept;

/// Maximum damping B [N s/mm] that the servo may add to a spring while the loop is stable; to 1e-9
/// of it.
[[nodiscard]] double stable_damping(const SampledLoop& loop, double stiffness_n_per_mm) noexcept;

/// Maximum accepted stiffness of a contact: half of the passive bound. The margin covers effects
/// that the theory ignores: encoder steps, late ticks, a damping known only to a factor.
[[nodiscard]] double accepted_stiffness(const SampledLoop& loop) noexcept;

/// A refused stiffness, and the two remedies.
struct StiffnessTooHigh {
  double found_n_per_mm;
  double highest_n_per_mm;  ///< the accepted stiffness at this rate
  double lowest_rate_hz;    ///< the rate from which the stiffness found is accepted
};

/// Refuses NaN and values above accepted_stiffness.
[[nodiscard]] tl::expected<void, StiffnessTooHigh> check_stiffness(
    const SampledLoop& loop, double stiffness_n_per_mm) noexcept;

// ---- passivity -----------------------------------------------------------------------
// Prevents a servo from feeding energy to the hand. The passivity controller of B. Hannaford, J.-H.
// Ryu, "Time-domain passivity control of haptic interfaces", IEEE Trans. Robotics and Automation
// 18(1), 2002, observes the net energy that the servo has given to the hand, and adds damping that
// removes it. Before it stands a bound, after J.-P. Kim, J. Ryu, "Robustly stable haptic
// interaction control using an energy-bounding algorithm", Int. J. Robotics Research 29(6), 2010:
// force builds up only by motion into the contact, at accepted_stiffness at most. A softer contact
// passes unchanged. Where readings come more slowly than stated, the accepted stiffness is that of
// their rate. After it, for cases in which damping does not help (a larger delay than
// stated), the bound is halved, and finally the force is switched off.
//
//   watching <-> damping     builds up at accepted_stiffness; damping while there is a debt
//       +-----+-----+
//          yielding          builds up at half of it, until reset
//             |
//            safe            no force, until reset
//
// It has no clock: time comes with the readings. Friction of the turning wheel may do work on the
// hand: pass the spring force of the contact only, and add friction afterwards.

struct PassivitySettings {
  SampledLoop loop;      ///< mass and damping: guaranteed minima
  double step_mm = 0.0;  ///< of the encoders
  double energy_limit_mj = 5.0;
  double energy_window_s = 0.1;     ///< escalates if more than the limit was given in this time
  int reversal_limit = 8;           ///< 2 to 16
  double reversal_window_s = 0.05;  ///< escalates after that many swings of the force in this time
  double reversal_force_n = 1.0;    ///< minimum swing that counts, from one turn to the next
};

enum class PassivityState { watching, damping, yielding, safe };

struct PassiveForce {
  glm::dvec3 force_n{0.0};
  PassivityState state = PassivityState::watching;
};

class PassivityLaw;

class PassivityController {
 public:
  /// Refuses the loops that `check` refuses; a step outside 0 to 10 mm; limits that are not above
  /// 0, or windows above 10 s. The other functions do not allocate.
  static tl::expected<PassivityController, OutOfRange> build(const PassivitySettings& settings);
  PassivityController(PassivityController&&) noexcept;
  PassivityController& operator=(PassivityController&&) noexcept;
  ~PassivityController();

  /// The force [N] to send for the force that the contact requests at this reading. Zero, without
  /// counting the tick, if an argument is not finite or time does not advance.
  [[nodiscard]] PassiveForce tick(std::int64_t time_us, const glm::dvec3& reading_mm,
                                  const glm::dvec3& force_n) noexcept;

  /// Call with the force [N] that was displayed instead of the last result, if a guard reduced it:
  /// the energy account uses this one. Ignored if not finite.
  void displayed(const glm::dvec3& force_n) noexcept;

  /// Restores the initial state: the next reading is the first.
  void reset() noexcept;

  [[nodiscard]] PassivityState state() const noexcept;
  /// The mean rate of the readings, if it is clearly lower than that of the loop: the accepted
  /// stiffness is then that of this rate.
  [[nodiscard]] std::optional<double> slow_rate_hz() const noexcept;

 private:
  explicit PassivityController(std::unique_ptr<PassivityLaw> law) noexcept;
  std::unique_ptr<PassivityLaw> law_;
};

}  // namespace clay::falcon::inline safety
