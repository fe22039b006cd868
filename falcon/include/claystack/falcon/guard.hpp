#pragma once
#include "claystack/falcon/device.hpp"

#include <atomic>
#include <cstdint>
#include <glm/vec3.hpp>
#include <tl/expected.hpp>

namespace clay::falcon::inline safety {

// ---- guard settings ------------------------------------------------------------------
// What the guard lets through and when it lets go. Sources: CHAI3D 3.3.0 has the small force and
// the rise over 2 s (there off by default) and 8 N as the Falcon's force; a hand left alone with
// a 0.1 kg handle and 5 N is at 0.5 m/s and 2.5 mm after 10 ms, at 1.6 m/s and 26 mm after the
// 32 ms of CHAI3D's watchdog: hence 10 ms. The rest is our judgement, and says so.

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
  int small_force_ticks = 5;   ///< for this number of ticks, 1 to 1000 (CHAI3D: > 3)
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
  double safe_rest_s = 0.1;  ///< good frames before a SAFE that clears itself ends, 0.01 to 10
};

/// The first setting that is no number or out of its range, which other settings may bound.
[[nodiscard]] tl::expected<void, OutOfRange> check(const GuardSettings& settings) noexcept;

// ---- guard rules ---------------------------------------------------------------------
// The rules of the guard, each a unit of its own. Time that lets force grow is counted short,
// time that takes it away is counted long: so a clock that stands, leaps or runs backwards can
// take force away and never give any.

/// Seconds from one reading of the clock to a later one; 0 when the clock went back. At most 1000.
[[nodiscard]] double elapsed_s(std::int64_t from_us, std::int64_t to_us) noexcept;

/// The way from `before` to `wanted`, in one tick: to let go costs nothing, so the force may first
/// shrink to any part of `before`; from there it goes `rise` at most. A force that turns
/// about thus begins again at 0.
[[nodiscard]] glm::dvec3 limit_rise(const glm::dvec3& wanted, const glm::dvec3& before,
                                    double rise) noexcept;

/// 1 up to `from`, 0 from `zero` on, a line between.
[[nodiscard]] double fade(double age, double from, double zero) noexcept;

/// How long the last tick was.
struct TickTime {
  double real_s = 0.0;     ///< by the clock
  double growing_s = 0.0;  ///< counted short: at most a period
  double fading_s = 0.0;   ///< counted long: at least kShortestStepS
};

class TickClock {
 public:
  [[nodiscard]] TickTime advance(std::int64_t now_us, double period_s) noexcept;

 private:
  std::int64_t last_us_ = 0;
  bool started_ = false;
};

/// How old the newest of a stream of stamped things is: by its stamp and by our own ticks,
/// whichever says more.
class Age {
 public:
  /// A thing with this stamp is there, unless it is the last one again.
  void see(std::int64_t stamp_us, std::int64_t now_us) noexcept;
  void pass(double fading_s) noexcept { passed_s_ += fading_s; }
  [[nodiscard]] double at(std::int64_t now_us) const noexcept;
  [[nodiscard]] bool is_last(std::int64_t stamp_us) const noexcept;
  [[nodiscard]] std::int64_t stamp_us() const noexcept { return stamp_us_; }
  [[nodiscard]] bool any() const noexcept { return any_; }
  void forget() noexcept { *this = {}; }

 private:
  std::int64_t stamp_us_ = 0;
  double passed_s_ = 0.0;
  bool any_ = false;
};

/// Positions faster than a hand. One frame alone is dropped; where the next stands by it, or is as
/// far elsewhere, the jump stays.
class JumpFilter {
 public:
  enum class Verdict { plausible, dropped, stays };

  /// `reach_mm`: how far a hand gets since the last plausible frame. A jump that stays is believed
  /// from the next frame on.
  [[nodiscard]] Verdict take(const glm::dvec3& position_mm, double reach_mm) noexcept;
  void forget() noexcept { *this = {}; }

 private:
  glm::dvec3 plausible_mm_{0.0}, suspect_mm_{0.0};
  bool any_ = false, suspected_ = false;
};

/// Force is earned: little has to be wanted for some ticks, then it grows in a line.
class Engagement {
 public:
  enum class Phase { waiting, ramping, engaged };

  void restart() noexcept { *this = {}; }
  /// A tick of waiting in which this much was wanted [N].
  void want(double wanted_n, double small_n, int ticks) noexcept;
  void grow(double growing_s, double ramp_s) noexcept;
  [[nodiscard]] double gain() const noexcept { return gain_; }
  [[nodiscard]] Phase phase() const noexcept { return phase_; }

 private:
  Phase phase_ = Phase::waiting;
  int small_ticks_ = 0;
  double gain_ = 0.0;
};

/// Motors that pushed hard for long. What cools counts as much as what warms.
class HeatLimit {
 public:
  /// The force held in the last tick.
  void hold(double force_n, double hot_n, const TickTime& time, double most_s) noexcept;
  /// Once hot, fades within `fade_s`. True when it has come to 0, once: then force is to be
  /// earned anew.
  [[nodiscard]] bool fade_out(double fading_s, double fade_s) noexcept;
  [[nodiscard]] double gain() const noexcept { return gain_; }
  [[nodiscard]] bool fading() const noexcept { return fading_; }

 private:
  double hot_s_ = 0.0, gain_ = 1.0;
  bool fading_ = false;
};

// ---- force guard ---------------------------------------------------------------------
// Between every force and every device. A state machine on a clock that it is told: no thread, no
// clock of its own, no allocation, no exception, so that each fault is a test. Each tick, in order:
//
//   const Admission admission = guard.admit(now_us, sample);  // the hand's position, or not
//   ... where admission.may_deform, deform the clay; compute the force wanted ...
//   device.write(guard.force(now_us, wanted).force_n);        // now_us read again before this
//
// docs/force-guard.md has the faults it must survive and which rule answers each.

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
  safe,    ///< 0 until rearm(), or after a rest where the cause clears itself
};

/// Why the guard is safe.
enum class SafeCause {
  none,
  not_finite,   ///< force or position, not_finite_ticks in a row
  not_passive,  ///< the loop is unstable: lower the stiffness
  jumped,       ///< the position leapt and stays; clears itself
  overrun,      ///< a tick came later than pause_s; clears itself
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

/// Rules are bits of falcon/safety/force_guard.hpp. Every program uses ForceGuard, which has all of
/// them; the tests compile guards that lack one, to show what that rule holds back.
template <std::uint32_t rules>
class BasicForceGuard {
 public:
  [[nodiscard]] static tl::expected<BasicForceGuard, OutOfRange> make(
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
  explicit BasicForceGuard(const GuardSettings& settings) noexcept : settings_(settings) {}
  [[nodiscard]] static constexpr bool on(std::uint32_t rule) noexcept {
    return (rules & rule) != 0;
  }
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

inline constexpr std::uint32_t kAllGuardRules = ~0u;
extern template class BasicForceGuard<kAllGuardRules>;
using ForceGuard = BasicForceGuard<kAllGuardRules>;

// ---- force gate ----------------------------------------------------------------------
// One owner of the force, and a last packet that is zero. The servo passes the gate for each packet
// it writes. Whoever has to end the force (the watchdog, a signal, an exception, the end of the
// program) closes the gate and then writes zero himself; a servo that was inside meanwhile is told
// on its way out, and writes zero once more. So in every order of events the last whole packet
// is a zero, and no two threads command a force.

class ForceGate {
 public:
  /// The servo, before it writes a force. False: it must not, since the gate is shut or another
  /// thread is inside.
  [[nodiscard]] bool enter() noexcept {
    std::uint32_t open = 0;
    return state_.compare_exchange_strong(open, kInside, std::memory_order_acquire,
                                          std::memory_order_relaxed);
  }

  /// After it has written. False: the gate was shut meanwhile, so zero has to be written again.
  [[nodiscard]] bool leave() noexcept {
    return (state_.fetch_and(~kInside, std::memory_order_release) & kShut) == 0;
  }

  /// No force from now on: to be called before writing zero. Safe in a signal handler.
  void shut() noexcept { state_.fetch_or(kShut, std::memory_order_acq_rel); }

  /// Lets forces through again. Only the servo may, when it is alive again after the watchdog shut
  /// the gate, and its guard has seen the late tick. False when shut for good.
  bool open() noexcept {
    std::uint32_t shut = kShut;
    return state_.compare_exchange_strong(shut, 0, std::memory_order_acq_rel) || shut == 0;
  }

  /// As shut(), for ever: open() fails from now on. Safe in a signal handler.
  void shut_for_good() noexcept { state_.fetch_or(kShut | kForGood, std::memory_order_acq_rel); }

  [[nodiscard]] bool is_shut() const noexcept {
    return (state_.load(std::memory_order_acquire) & kShut) != 0;
  }
  [[nodiscard]] bool is_shut_for_good() const noexcept {
    return (state_.load(std::memory_order_acquire) & kForGood) != 0;
  }

 private:
  static constexpr std::uint32_t kInside = 1, kShut = 2, kForGood = 4;
  static_assert(std::atomic<std::uint32_t>::is_always_lock_free, "signal handlers rely on it");

  std::atomic<std::uint32_t> state_{0};
};

/// What a signal handler calls: shuts the gate for good, then writes zero. The function is the
/// device's, and must be async-signal-safe (one write(2) of a frame made beforehand, no lock, no
/// allocation). Install one in a static place before the force engages.
class EmergencyStop {
 public:
  using WriteZero = void (*)(void* device) noexcept;

  /// `gate` and `device` must outlive every call of fire(). Not safe in a signal handler. nullptr
  /// as `write_zero` disarms.
  void arm(ForceGate& gate, WriteZero write_zero, void* device) noexcept {
    write_zero_.store(nullptr, std::memory_order_release);
    gate_.store(&gate, std::memory_order_relaxed);
    device_.store(device, std::memory_order_relaxed);
    write_zero_.store(write_zero, std::memory_order_release);
  }

  /// From a signal handler, std::terminate, a destructor; again and again if need be.
  void fire() noexcept {
    const WriteZero write_zero = write_zero_.load(std::memory_order_acquire);
    if (write_zero == nullptr) return;
    gate_.load(std::memory_order_relaxed)->shut_for_good();
    write_zero(device_.load(std::memory_order_relaxed));
  }

 private:
  static_assert(std::atomic<WriteZero>::is_always_lock_free &&
                std::atomic<void*>::is_always_lock_free);

  std::atomic<WriteZero> write_zero_{nullptr};
  std::atomic<ForceGate*> gate_{nullptr};
  std::atomic<void*> device_{nullptr};
};

// ---- watchdog ------------------------------------------------------------------------
// For a thread of its own, since a servo that hangs can't watch itself. Pure: both times are told.

/// The servo leaves the time of each tick where the watchdog finds it (an atomic); the watchdog
/// sleeps until next_look_us and closes the gate (force_gate.hpp) for a while when it must.
class Watchdog {
 public:
  static constexpr std::int64_t kPatienceUs = 10'000;

  /// Is the last heartbeat 10 ms old, or so far ahead that one of the clocks is wrong? A
  /// heartbeat a little ahead is one that came after `now_us` was read.
  [[nodiscard]] static constexpr bool must_zero(std::int64_t heartbeat_us,
                                                std::int64_t now_us) noexcept {
    const auto apart =
        heartbeat_us < now_us ? distance(heartbeat_us, now_us) : distance(now_us, heartbeat_us);
    return apart >= static_cast<std::uint64_t>(kPatienceUs);
  }

  /// When this heartbeat will have been the last for too long.
  [[nodiscard]] static constexpr std::int64_t next_look_us(std::int64_t heartbeat_us) noexcept {
    constexpr std::int64_t kLast = INT64_MAX - kPatienceUs;
    return heartbeat_us > kLast ? INT64_MAX : heartbeat_us + kPatienceUs;
  }

 private:
  /// Of two signed numbers, which may not fit one.
  static constexpr std::uint64_t distance(std::int64_t low, std::int64_t high) noexcept {
    return static_cast<std::uint64_t>(high) - static_cast<std::uint64_t>(low);
  }
};

}  // namespace clay::falcon::inline safety
