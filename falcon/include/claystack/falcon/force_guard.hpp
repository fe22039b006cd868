#pragma once
// Between every force and every device. A state machine on a clock that it is told: no thread, no
// clock of its own, no allocation, no exception, so that each fault is a test. Each tick, in order:
//
//   const Admission admission = guard.admit(now_us, sample);  // the hand's position, or not
//   ... where admission.may_deform, deform the clay; compute the force wanted ...
//   device.write(guard.force(now_us, wanted).force_n);        // now_us read again before this
//
// docs/force-guard.md has the faults it must survive and which rule answers each.

#include "claystack/falcon/guard_rules.hpp"
#include "claystack/falcon/guard_settings.hpp"

#include <cstdint>
#include <glm/vec3.hpp>
#include <tl/expected.hpp>

namespace clay::falcon {

/// What the device says of the hand.
struct GuardSample {
  std::int64_t time_us = 0;     ///< when the frame came, on the clock of `now_us`
  glm::dvec3 position_mm{0.0};  ///< in the device's frame
  bool fresh = false;  ///< a new frame; with the stamp of the last one it is that one again
  bool ready = false;  ///< homed, powered, plugged in, no fault
};

/// The force that the clay asks for.
struct WantedForce {
  glm::dvec3 force_n{0.0};        ///< anything: NaN, infinite, huge
  std::int64_t clay_time_us = 0;  ///< of the state of the clay that it was computed from
  bool passive =
      true;  ///< false: the loop gave energy and could not be made passive (passivity.hpp)
};

enum class GuardState {
  idle,     ///< the device is not ready, or has sent no frame yet
  waiting,  ///< for a small force
  ramping,
  engaged,
  fading,  ///< ramping or engaged, and letting go: stale frames, old clay, hot motors
  safe,    ///< 0 until rearm(), or after a rest where the cause mends itself
};

/// Why the guard is safe.
enum class SafeCause {
  none,
  not_finite,   ///< force or position, not_finite_ticks in a row
  not_passive,  ///< the loop is unstable: lower the stiffness
  jumped,       ///< the position leapt and stays; mends itself
  overrun,      ///< a tick came later than pause_s; mends itself
  paused,       ///< asked for
  stopped,      ///< asked for, and for good
};

/// What a tick met, all of it.
enum GuardFlag : std::uint32_t {
  kGuardNotReady = 1u << 0,
  kGuardNotFinite = 1u << 1,  ///< position or force; 0 this tick
  kGuardLimited = 1u << 2,    ///< more than the limit was wanted
  kGuardSlewed = 1u << 3,     ///< the force rises slower than wanted
  kGuardJump = 1u << 4,       ///< a frame dropped as faster than a hand
  kGuardStale = 1u << 5,      ///< frames older than stale_fade_s
  kGuardLate = 1u << 6,       ///< the tick came late_zero_s late or more; 0 this tick
  kGuardOldClay = 1u << 7,    ///< clay older than clay_fade_s
  kGuardHot = 1u << 8,        ///< motors hot: fading
  kGuardClock = 1u << 9,      ///< the clock went back or stood
};

struct Admission {
  bool may_deform = false;  ///< a fresh, plausible frame of a device that is ready, guard not safe
  double step_s =
      kShortestStepS;       ///< since the last plausible frame, kShortestStepS to kLongestStepS
  std::uint32_t flags = 0;  ///< of GuardFlag
};

struct GuardedForce {
  glm::dvec3 force_n{0.0};  ///< what may be sent: finite, at most force_limit_n
  double gain = 0.0;        ///< part of the wanted force that is earned, 0 to 1: the ramp
  GuardState state = GuardState::idle;
  SafeCause cause = SafeCause::none;
  std::uint32_t flags = 0;  ///< of GuardFlag
};

class ForceGuard {
 public:
  [[nodiscard]] static tl::expected<ForceGuard, OutOfRange> make(
      const GuardSettings& settings) noexcept;

  /// First half of a tick: is this sample to be believed?
  [[nodiscard]] Admission admit(std::int64_t now_us, const GuardSample& sample) noexcept;

  /// Second half: what may be sent of the force wanted. Without admit() before it, frames age.
  [[nodiscard]] GuardedForce force(std::int64_t now_us, const WantedForce& wanted) noexcept;

  /// Zero until rearm().
  void pause() noexcept { latch(SafeCause::paused); }
  /// Zero for good.
  void stop() noexcept { latch(SafeCause::stopped); }
  /// The force last given was not sent, or not kept: the watchdog was at the device. It rises from
  /// 0.
  void was_zeroed() noexcept { sent_n_ = glm::dvec3(0.0); }
  /// Leaves SAFE or a pause; force is then earned anew. False when stopped.
  bool rearm() noexcept;

  [[nodiscard]] const GuardSettings& settings() const noexcept { return settings_; }

 private:
  friend class GuardWithout;  // in the tests: the guard less one rule

  explicit ForceGuard(const GuardSettings& settings) noexcept : settings_(settings) {}
  [[nodiscard]] bool on(std::uint32_t rule) const noexcept { return (rules_ & rule) != 0; }
  void latch(SafeCause cause) noexcept;
  [[nodiscard]] bool is_new_frame(const GuardSample& sample) noexcept;
  [[nodiscard]] bool take_frame(std::int64_t now_us, const GuardSample& sample,
                                Admission& admission) noexcept;
  void watch_force(const WantedForce& wanted) noexcept;
  void watch_clock(const TickTime& time) noexcept;
  void watch_ages(const TickTime& time, std::int64_t now_us, const WantedForce& wanted) noexcept;
  void rest(double growing_s) noexcept;
  [[nodiscard]] glm::dvec3 limit(const glm::dvec3& wanted_n) noexcept;
  [[nodiscard]] double let_go(const TickTime& time, std::int64_t now_us) noexcept;
  void earn(const glm::dvec3& limited_n, double growing_s) noexcept;
  [[nodiscard]] glm::dvec3 rise(const glm::dvec3& force_n, double growing_s) noexcept;
  [[nodiscard]] GuardState state(double held) const noexcept;

  GuardSettings settings_;
  std::uint32_t rules_ = ~0u;  // bits of src/guard_rule.hpp
  SafeCause cause_ = SafeCause::none;
  TickClock clock_;
  Age frame_age_, clay_age_;
  JumpFilter jumps_;
  Engagement engagement_;
  HeatLimit heat_;
  double rested_s_ = 0.0;
  std::int64_t seen_us_ = 0;  // stamp of the newest frame, plausible or not
  bool seen_ = false;
  int not_finite_ticks_ = 0;
  std::uint32_t flags_ = 0;  // of the tick that runs
  bool ready_ = false, admitted_ = false;
  glm::dvec3 sent_n_{0.0};
};

}  // namespace clay::falcon
