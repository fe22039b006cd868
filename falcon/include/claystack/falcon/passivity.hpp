#pragma once
#include "claystack/falcon/device.hpp"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <glm/vec3.hpp>
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

/// Rates of 10 to 100 000 Hz, masses of 1 g to 100 kg, damping of 0 to 1 N s/mm, 0 to 8 ticks.
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

// ---- energy observer -----------------------------------------------------------------
// The passivity observer: the net energy that the servo has given to the hand. After B.
// Hannaford, J.-H. Ryu, "Time-domain passivity control of haptic interfaces", IEEE Trans. Robotics
// and Automation 18(1), 2002. Work is the force held over a period
// times the displacement, which is exact except for encoder steps. A spring read by an encoder
// seems to release K step^2 whenever the reading of a resting hand flickers, so loops of up to
// four steps do not count.

/// Energy of each contact, and of a recent window of time.
class EnergyObserver {
 public:
  /// `loop` must pass `check`; its damping is the guaranteed minimum of the arm. `step_mm`: of the
  /// encoders. `window_s` > 0: the window of recent_mj().
  EnergyObserver(const SampledLoop& loop, double step_mm, double window_s) noexcept;

  /// A period of `dt_s` in which `held_n` was displayed and the reading moved by `way_mm`; at its
  /// end the contact requests `asked_n`. True if a contact has ended with it.
  bool observe(double dt_s, const glm::dvec3& held_n, const glm::dvec3& way_mm,
               const glm::dvec3& asked_n) noexcept;

  /// Work displayed [mJ] minus the guaranteed dissipation by the arm's damping in contact. Negative
  /// while a contact has credit. Credit ends with its contact; a debt remains.
  [[nodiscard]] double injected_mj() const noexcept { return injected_; }
  /// The larger of injected_mj() and the same for oscillations within a contact, which a long press
  /// would hide by its credit: the sum over the loops from one deepest point to the next, closed by
  /// any spring whose force grows with depth. It never falls below zero.
  [[nodiscard]] double debt_mj() const noexcept { return std::max(injected_, looped_); }
  /// Error bound of these values due to encoder steps: half a step times the total variation of the
  /// force in this contact or the last.
  [[nodiscard]] double tolerance_mj() const noexcept {
    return step_mm_ * std::max(peak_n_, last_peak_n_) + kRounding;
  }
  /// Energy that the last contact added to the debt.
  [[nodiscard]] double last_contact_mj() const noexcept { return last_contact_; }
  /// Energy given within the window: by contacts that ended with a gain, and by the current one if
  /// positive.
  [[nodiscard]] double recent_mj() const noexcept;
  [[nodiscard]] bool in_contact() const noexcept { return in_contact_; }

  /// Clears the debt; the current contact continues.
  void forgive() noexcept;

 private:
  static constexpr std::size_t kBuckets = 16;
  static constexpr double kRounding = 1e-6;  // mJ

  /// A motion in one direction, into the contact or out of it. Depths count from its start.
  struct Stroke {
    double sign = 0.0;  // +1 into the contact, -1 out of it
    double from_mm = 0.0;
    double depth_mm = 0.0;     // of the arm now
    double furthest_mm = 0.0;  // maximum
    double force_n = 0.0;      // at the maximum
    double doubtful_mj = 0.0;  // work and time since the maximum
    double doubtful_s = 0.0;
    double time_s = 0.0;
    double credit_mj = 0.0;  // guaranteed dissipation by the arm
  };
  /// A deepest point of the contact, where the arm turned back.
  struct Turn {
    double injected_mj, depth_mm, force_n;
  };

  void begin_contact(double dt_s, const glm::dvec3& way_mm) noexcept;
  void follow_stroke(double dt_s, double held_n, double inward_mm) noexcept;
  void credit_stroke() noexcept;
  void close_loop() noexcept;
  void end_contact() noexcept;
  [[nodiscard]] double given() const noexcept;
  void pass_time(double dt_s) noexcept;

  double damping_, step_mm_, mark_s_;
  int drain_ticks_;
  double injected_ = 0.0, before_contact_ = 0.0, last_contact_ = 0.0;
  double peak_n_ = 0.0, last_peak_n_ = 0.0;
  double gains_ = 0.0;  // of all contacts that ended
  bool in_contact_ = false;
  int quiet_ticks_ = 0;  // since the contact last requested a force
  Stroke stroke_;
  std::optional<Turn> last_turn_;
  double looped_ = 0.0;
  std::array<double, kBuckets> given_before_{};  // given() at equal parts of the window, a ring
  std::size_t oldest_ = 0;
  double since_mark_s_ = 0.0;
};

// ---- passivity -----------------------------------------------------------------------
// Prevents a servo from feeding energy to the hand. The passivity controller of Hannaford and Ryu
// (see EnergyObserver) adds damping that removes the energy found by the observer. Before it stands
// a bound, after J.-P. Kim, J. Ryu, "Robustly stable haptic interaction control using an
// energy-bounding algorithm", Int. J. Robotics Research 29(6), 2010: force builds up only by
// motion into the contact, at accepted_stiffness at most. A softer contact passes unchanged. After
// it, for cases in which damping does not help (a larger delay than stated), the bound is halved,
// and finally the force is switched off.
//
//   watching <-> damping     builds up at accepted_stiffness; damping while there is a debt
//       +-----+-----+
//          yielding          builds up at half of it, until reset
//             |
//            safe            no force, until reset
//
// It has no clock: time comes with the readings. Friction of the turning wheel may do work on the
// hand: pass the spring force of the contact only, and add friction afterwards.

struct PassivitySpec {
  SampledLoop loop;      ///< mass and damping: guaranteed minima
  double step_mm = 0.0;  ///< of the encoders
  double energy_limit_mj = 5.0;
  double energy_window_s = 0.1;     ///< escalates if more than the limit was given in this time
  int reversal_limit = 8;           ///< 2 to 16
  double reversal_window_s = 0.05;  ///< escalates after that many swings of the force in this time
  double reversal_force_n = 1.0;    ///< minimum swing that counts, from one turn to the next
};

/// Counts reversals of a force in any direction.
class SwingCounter {
 public:
  SwingCounter(int limit, double window_s, double least_n) noexcept;
  /// The force at an increasing time [s]. True if `limit` swings ended within the window.
  bool swings_too_often(double time_s, const glm::dvec3& force_n) noexcept;

 private:
  static constexpr std::size_t kMost = 16;
  std::size_t limit_, count_ = 0;
  double window_s_, least_n_;
  glm::dvec3 extreme_{0.0}, direction_{0.0};
  std::array<double, kMost> times_s_{};  // of the last swings, a ring
};

enum class PassivityState { watching, damping, yielding, safe };

struct PassiveForce {
  glm::dvec3 force_n{0.0};
  PassivityState state = PassivityState::watching;
};

class PassivityController {
 public:
  /// Refuses what `check` of the loop refuses; a step outside 0 to 10 mm; limits that are not
  /// above 0, or windows above 10 s.
  static tl::expected<PassivityController, OutOfRange> build(const PassivitySpec& spec) noexcept;

  /// The force [N] to send for the force that the contact requests at this reading. Zero, without
  /// counting the tick, if an argument is not finite or time does not advance.
  [[nodiscard]] PassiveForce tick(std::int64_t time_us, const glm::dvec3& reading_mm,
                                  const glm::dvec3& force_n) noexcept;

  /// Call with the force [N] that was displayed instead of the last result, if a guard reduced it:
  /// the energy account uses this one. Ignored if not finite.
  void displayed(const glm::dvec3& force_n) noexcept;

  /// Restores the initial state: the next reading is the first.
  void reset() noexcept { *this = PassivityController(spec_); }

  [[nodiscard]] const EnergyObserver& observer() const noexcept { return observer_; }
  [[nodiscard]] PassivityState state() const noexcept { return state_; }
  /// Maximum damping that the controller adds [N s/mm]: half of the stable maximum on top of the
  /// accepted stiffness, and small enough that one encoder step per period changes the force by at
  /// most a quarter of `reversal_force_n`.
  [[nodiscard]] double most_damping_ns_per_mm() const noexcept { return most_damping_; }

 private:
  static constexpr std::size_t kMostSent = 9;

  explicit PassivityController(const PassivitySpec& spec) noexcept;
  void judge(bool contact_ended, const glm::dvec3& asked_n) noexcept;
  void count_debt() noexcept;
  void escalate() noexcept;
  [[nodiscard]] glm::dvec3 answer(double dt_s, const glm::dvec3& way_mm,
                                  const glm::dvec3& asked_n) noexcept;
  [[nodiscard]] glm::dvec3 earned(const glm::dvec3& way_mm, const glm::dvec3& asked_n) noexcept;
  [[nodiscard]] glm::dvec3 damping(double dt_s, const glm::dvec3& way_mm) const noexcept;
  void send(const glm::dvec3& force_n) noexcept;

  PassivitySpec spec_;
  double stiffness_, most_damping_;
  EnergyObserver observer_;
  SwingCounter swings_;
  PassivityState state_ = PassivityState::watching;
  double earned_n_ = 0.0;          // maximum force permitted by the motion into the contact
  double last_requested_n_ = 0.0;  // in this contact
  int debts_ = 0;                  // since the last quiet interval
  double last_debt_s_ = 0.0;

  struct Reading {
    std::int64_t time_us;
    glm::dvec3 at_mm;
  };
  std::optional<Reading> last_;
  double now_s_ = 0.0;                        // since the first reading
  std::array<glm::dvec3, kMostSent> sent_{};  // a ring of delay + 1: the oldest is held now
  std::size_t oldest_ = 0, newest_ = 0;
  glm::dvec3 last_sent_{0.0};
};

}  // namespace clay::falcon::inline safety
