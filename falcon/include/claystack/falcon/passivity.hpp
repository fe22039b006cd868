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
// How stiff a wall can be that a sampled arm renders. A wall read once a period and held for the
// next is late, and what is late gives back more than it took; the arm's own damping has to eat
// the difference. Sources: J. E. Colgate, G. G. Schenkel, "Passivity of a class of sampled-data
// systems: application to haptic interfaces", J. Robotic Systems 14(1), 1997; E. I. Jury, "Theory
// and Application of the z-Transform Method", 1964 (the stability of a sampled loop).
//
// Units as everywhere in falcon: mm, s, N, and so mJ = N mm. T = 1 / rate is the period, n the
// ticks of delay.

/// What of an arm and its servo decides how stiff a wall may be.
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

/// Damping [N s/mm] that an arm needs so that, whatever passive hand holds it, the wall gives no
/// energy away. Colgate and Schenkel's integral for this wall is a sum of cosines,
///
///   b > max over w of  K T/2 (1 + 2 cos wT + ... + 2 cos nwT) - B cos((n + 1) wT),
///
/// and K T/2 + |B| without delay, (2n + 1) K T/2 for a spring alone.
[[nodiscard]] double passive_damping(const SampledLoop& loop, const VirtualWall& wall) noexcept;
/// The same at one angle w T [rad], 0 to pi: what a motion of that frequency asks for.
[[nodiscard]] double passive_damping_at(const SampledLoop& loop, const VirtualWall& wall,
                                        double angle_rad) noexcept;

/// Stiffest spring [N/mm] that is passive: 2b / ((2n + 1) T).
[[nodiscard]] double passive_stiffness(const SampledLoop& loop) noexcept;

/// Does the free arm come to rest against the wall, held there? By Jury's test of
///
///   z^(n+1) (z - 1)(z - p) + (K z + B (z - 1)/T)(c1 z + c0),    p = e^(-bT/m),
///
/// where (c1 z + c0) / ((z - 1)(z - p)) takes held force to position, exactly.
[[nodiscard]] bool is_stable(const SampledLoop& loop, const VirtualWall& wall) noexcept;

/// The border of the stable springs [N/mm], to 1e-9 of it: stable below, not above. 0 when none is.
/// `wall_damping_ns_per_mm` is B.
[[nodiscard]] double stable_stiffness(const SampledLoop& loop,
                                      double wall_damping_ns_per_mm = 0.0) noexcept;

/// Most damping B [N s/mm] that the servo may add to a spring before the loop is unstable; to 1e-9
/// of it.
[[nodiscard]] double stable_damping(const SampledLoop& loop, double stiffness_n_per_mm) noexcept;

/// Stiffest contact that is let through: half of what is passive. The other half is for what the
/// theory leaves out: encoder steps, late ticks, a damping known to a factor.
[[nodiscard]] double accepted_stiffness(const SampledLoop& loop) noexcept;

/// Why a stiffness is refused, and the two ways out.
struct StiffnessTooHigh {
  double found_n_per_mm;
  double highest_n_per_mm;  ///< the accepted stiffness at this rate
  double lowest_rate_hz;    ///< the rate from which the stiffness found is accepted
};

/// Refuses what is above accepted_stiffness, and what is not a number.
[[nodiscard]] tl::expected<void, StiffnessTooHigh> check_stiffness(
    const SampledLoop& loop, double stiffness_n_per_mm) noexcept;

// ---- energy observer -----------------------------------------------------------------
// The passivity observer: what the servo has given the hand beyond what it took. After B.
// Hannaford, J.-H. Ryu, "Time-domain passivity control of haptic interfaces", IEEE Trans. Robotics
// and Automation 18(1), 2002. Work is counted by positions: the force held over a period times the
// way gone in it is exact, but for the encoder's steps. A spring that an encoder reads seems to
// give K step^2 whenever a still hand makes it flicker, so that loops of up to two steps count
// nothing.

/// Energy of one contact after the other, and of the last while.
class EnergyObserver {
 public:
  /// `loop` as `check` lets it through; its damping is what the arm has for sure. `step_mm`: of the
  /// encoders. `window_s` > 0: the last while.
  EnergyObserver(const SampledLoop& loop, double step_mm, double window_s) noexcept;

  /// A period of `dt_s` in which `held_n` was displayed and the reading moved by `way_mm`; at its
  /// end the contact asks for `asked_n`. True when a contact has ended with it.
  bool observe(double dt_s, const glm::dvec3& held_n, const glm::dvec3& way_mm,
               const glm::dvec3& asked_n) noexcept;

  /// Work displayed [mJ] less what the arm's own damping has dissipated for sure in contact.
  /// Negative while a contact has credit. Credit ends with its contact, a debt stays.
  [[nodiscard]] double injected_mj() const noexcept { return injected_; }
  /// The same for oscillations within a contact, which may have the credit of a long press: the
  /// sum over the loops from one deepest point to the next, closed by any spring whose force grows
  /// with depth; from zero again when it would fall below.
  [[nodiscard]] double looped_mj() const noexcept { return looped_; }
  [[nodiscard]] double debt_mj() const noexcept { return std::max(injected_, looped_); }
  /// What these may be off by for the encoder's steps: half a step times all that the force
  /// changed by, up and down, in this contact or the last.
  [[nodiscard]] double tolerance_mj() const noexcept {
    return step_mm_ * std::max(peak_n_, last_peak_n_) + kRounding;
  }
  /// Of the contact that has just ended: what it added to the debt.
  [[nodiscard]] double last_contact_mj() const noexcept { return last_contact_; }
  /// Given in the last while: by contacts that ended with a gain, and by the present one as far as
  /// it is above zero.
  [[nodiscard]] double recent_mj() const noexcept;
  [[nodiscard]] bool in_contact() const noexcept { return in_contact_; }

  /// The debt is forgiven; what is going on goes on.
  void forgive() noexcept;

 private:
  static constexpr std::size_t kBuckets = 16;
  static constexpr double kRounding = 1e-6;  // mJ

  /// A way in one direction, into the contact or out of it. Depths count from where it began.
  struct Stroke {
    double sign = 0.0;  // +1 into the contact, -1 out of it
    double from_mm = 0.0;
    double depth_mm = 0.0;     // where the arm is,
    double furthest_mm = 0.0;  // the furthest it was,
    double force_n = 0.0;      // the force there
    double doubtful_mj = 0.0;  // and the work and time since
    double doubtful_s = 0.0;
    double time_s = 0.0;
    double credit_mj = 0.0;  // dissipated for sure by the arm
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
  int quiet_ticks_ = 0;  // since the contact last asked for a force
  Stroke stroke_;
  std::optional<Turn> last_turn_;
  double looped_ = 0.0;
  std::array<double, kBuckets> given_before_{};  // given() at equal parts of the window, a ring
  std::size_t oldest_ = 0;
  double since_mark_s_ = 0.0;
};

// ---- passivity -----------------------------------------------------------------------
// Keeps a servo from feeding the hand energy: the passivity controller of Hannaford and Ryu (see
// energy_observer.hpp) adds damping that takes back what the observer saw given. Before it stands a
// bound, after J.-P. Kim, J. Ryu, "Robustly stable haptic interaction control using an
// energy-bounding algorithm", Int. J. Robotics Research 29(6), 2010: force has to be earned by the
// way into the contact, at accepted_stiffness at most. A contact as soft as that passes unchanged.
// Behind it, for what no damping saves (a force later than was said), the
// bound is halved, and then there is no force.
//
//   watching <-> damping     earned at accepted_stiffness; damping while there is a debt
//       +-----+-----+
//          yielding          earned at half of it, until reset
//             |
//            safe            no force, until reset
//
// It knows no clock: time comes with the readings. The turning wheel's friction drags the hand
// along and does work on it by right: pass the contact's spring force, and add friction after.

struct PassivitySpec {
  SampledLoop loop;      ///< mass: the least, damping: what the arm has for sure
  double step_mm = 0.0;  ///< of the encoders
  double energy_limit_mj = 5.0;
  double energy_window_s = 0.1;     ///< no patience when more than the limit was given in this time
  int reversal_limit = 8;           ///< 2 to 16
  double reversal_window_s = 0.05;  ///< nor when the force swung so often in this time
  double reversal_force_n = 1.0;    ///< least swing that counts, from one turn to the next
};

/// Counts how often a force turns back, whatever its direction.
class SwingCounter {
 public:
  SwingCounter(int limit, double window_s, double least_n) noexcept;
  /// The force at a time [s] that rises; true when `limit` swings ended within the window.
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

  /// The force [N] to send for the one that the contact asks for at this reading. Zero, and the
  /// tick is not counted, when an argument is not finite or time does not advance.
  [[nodiscard]] PassiveForce tick(std::int64_t time_us, const glm::dvec3& reading_mm,
                                  const glm::dvec3& force_n) noexcept;

  /// What is displayed [N] in place of the force that the last tick returned, where a guard behind
  /// it lets through less: the account is of this one. Not counted when it is not finite.
  void displayed(const glm::dvec3& force_n) noexcept;

  /// As new: the next reading is the first.
  void reset() noexcept { *this = PassivityController(spec_); }

  [[nodiscard]] const EnergyObserver& observer() const noexcept { return observer_; }
  [[nodiscard]] PassivityState state() const noexcept { return state_; }
  /// Most damping that the controller adds [N s/mm]: half of what the loop bears on top of the
  /// accepted stiffness, and so little that one encoder step in a period moves the force by a
  /// quarter of `reversal_force_n` at most.
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
  double earned_n_ = 0.0;      // most force that the way into the contact allows
  double last_asked_n_ = 0.0;  // in this contact
  int debts_ = 0;              // since the last good while
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
