#pragma once
#include "claystack/falcon/device.hpp"

#include <atomic>
#include <cstdint>
#include <glm/vec3.hpp>
#include <memory>
#include <tl/expected.hpp>

namespace clay::falcon::inline safety {

// ---- guard settings ------------------------------------------------------------------
// Limits and times of the guard. Sources: CHAI3D 3.3.0 uses the small force and the ramp of 2 s
// (off by default there), and 8 N as the Falcon's force. A free 0.1 kg handle under 5 N reaches 0.5
// m/s and 2.5 mm after 10 ms, 1.6 m/s and 26 mm after the 32 ms of CHAI3D's watchdog: hence 10 ms.
// Values without a source are marked as our judgement.

/// Limits that no setting can exceed.
inline constexpr double kMostForceN = 8.0;        ///< force of a Falcon in every direction
inline constexpr double kLongestToZeroS = 0.010;  ///< from a fault to force 0
inline constexpr double kShortestStepS = 0.0002;  ///< minimum time step for velocities
inline constexpr double kLongestStepS = 0.005;    ///< maximum time step of a frame

struct GuardSettings {
  /// Period of the servo, 0.1 to 2.5 ms. A late tick gets no more rise than one on time. Below
  /// 400 Hz, stale frames could not be detected in time.
  double period_s = 0.001;

  double force_limit_n = 5.0;   ///< maximum force, above 0 up to kMostForceN
  double slew_n_per_s = 500.0;  ///< maximum rise, 1 to 5000; falls are not limited. Our judgement

  double small_force_n = 0.2;  ///< to engage, the requested force is below this (CHAI3D)
  int small_force_ticks = 5;   ///< for this number of ticks, 1 to 1000 (CHAI3D: > 3)
  double ramp_s = 2.0;         ///< then the force ramps up within this, 0.1 to 60 s (CHAI3D)

  /// Age of the newest frame at which the force starts to fade: two periods or more. Our judgement.
  double stale_fade_s = 0.005;
  /// Age at which the force has ended: at least 1.5 periods and 1 ms more, up to kLongestToZeroS.
  /// The fade ends 1.5 periods before, because the device holds a force until the next tick.
  double stale_zero_s = 0.010;
  double late_zero_s = 0.010;  ///< a tick this late sends 0: two periods to kLongestToZeroS
  double pause_s = 0.050;      ///< a longer gap in ticks or frames is a pause: re-engage. To 1 s

  /// Frames with a faster motion are dropped; 100 to 10 000 (2 m/s is 2 mm in a tick of 1 ms).
  double jump_mm_per_s = 2000.0;

  double clay_fade_s = 0.100;  ///< age of the clay state at which the force starts to fade: to 1 s
  double clay_zero_s = 0.150;  ///< age at which it is 0: to 2 s

  double hot_force_n = 4.0;  ///< larger forces heat the motors: above 0 to force_limit_n
  double hot_time_s = 10.0;  ///< permitted duration of such forces, 0.1 to 60
  double hot_fade_s = 1.0;   ///< then the force fades within this, 0.05 to 10

  int not_finite_ticks = 3;  ///< consecutive ticks with NaN or infinity that lead to SAFE, 1 to 10
  double safe_rest_s =
      0.1;  ///< duration of valid frames that ends a self-clearing SAFE, 0.01 to 10
};

/// Returns the first setting that is NaN or out of range; some ranges depend on other settings.
[[nodiscard]] tl::expected<void, OutOfRange> check(const GuardSettings& settings) noexcept;

// ---- force guard ---------------------------------------------------------------------
// Stands between every force and every device. A state machine whose caller supplies the time: no
// thread, clock or exception, and no allocation after build(), so that every fault can be tested.
// Each tick, in order:
//
//   const Admission admission = guard.admit(now_us, sample);  // accept the position or not
//   ... if admission.may_deform, deform the clay; compute the requested force ...
//   device.write(guard.force(now_us, wanted).force_n);        // now_us read again before this
//
// docs/force-guard.md lists the faults and the rule for each.

/// A sample of the device.
struct GuardSample {
  std::int64_t time_us = 0;     ///< arrival of the frame, on the clock of `now_us`
  glm::dvec3 position_mm{0.0};  ///< in the device's frame
  /// A new frame, unless it has the stamp of the last one or one that is 10 ms ahead.
  bool fresh = false;
  bool ready = false;  ///< homed, powered, plugged in, no fault
};

/// The requested force.
struct WantedForce {
  glm::dvec3 force_n{0.0};        ///< any value, even NaN or infinite
  std::int64_t clay_time_us = 0;  ///< time of the clay state from which it was computed
  bool passive = true;            ///< false: the loop could not be made passive (passivity.hpp)
  /// Force [N] of the contact before a controller reduced it to `force_n`: while it is not small,
  /// the force does not engage.
  double contact_n = 0.0;
};

enum class GuardState {
  idle,     ///< the device is not ready, or has sent no frame yet
  waiting,  ///< for a small force
  ramping,  ///< increasing the part of the force: after waiting, fading or a tick that ended it
  engaged,
  fading,  ///< reducing the force: stale frames, old clay, hot motors
  safe,    ///< force 0 until rearm(), or for a while if the cause clears itself
};

/// The cause of the state `safe`.
enum class SafeCause {
  none,
  not_finite,   ///< force or position, not_finite_ticks in a row
  not_passive,  ///< the loop is unstable: lower the stiffness
  jumped,       ///< the position jumped and stays there; clears itself
  overrun,      ///< a tick came later than pause_s; clears itself
  paused,       ///< by pause()
  stopped,      ///< by stop(), permanently
};

/// True for the causes that only the user ends, by rearm().
[[nodiscard]] constexpr bool needs_rearm(SafeCause cause) noexcept {
  return cause == SafeCause::not_finite || cause == SafeCause::not_passive ||
         cause == SafeCause::paused;
}

/// Events of a tick.
enum GuardFlag : std::uint32_t {
  kGuardNotReady = 1u << 0,
  kGuardNotFinite = 1u << 1,  ///< position or force; force 0 in this tick
  kGuardLimited = 1u << 2,    ///< the requested force exceeded the limit
  kGuardSlewed = 1u << 3,     ///< the rise of the force was limited
  kGuardJump = 1u << 4,       ///< dropped a frame with a motion faster than a hand
  kGuardStale = 1u << 5,      ///< frames older than stale_fade_s
  kGuardLate = 1u << 6,       ///< the tick came late_zero_s late or more; force 0 in this tick
  kGuardOldClay = 1u << 7,    ///< clay older than clay_fade_s
  kGuardHot = 1u << 8,        ///< motors hot: fading
  /// The clock went back or stopped, or a frame was dropped whose stamp is 10 ms ahead of it.
  kGuardClock = 1u << 9,
};

struct Admission {
  bool may_deform = false;  ///< a fresh, plausible frame of a device that is ready, guard not safe
  double step_s =
      kShortestStepS;  ///< since the last plausible frame, kShortestStepS to kLongestStepS
};

struct GuardedForce {
  glm::dvec3 force_n{0.0};  ///< to be sent: finite, at most force_limit_n
  double gain = 0.0;        ///< part of the force that ramp and fades leave, 0 to 1
  GuardState state = GuardState::idle;
  SafeCause cause = SafeCause::none;
  std::uint32_t flags = 0;  ///< of GuardFlag
};

class ForceGuard {
 public:
  [[nodiscard]] static tl::expected<ForceGuard, OutOfRange> build(const GuardSettings& settings);
  ForceGuard(ForceGuard&&) noexcept;
  ForceGuard& operator=(ForceGuard&&) noexcept;
  ~ForceGuard();

  /// First half of a tick: decides whether the sample is accepted.
  [[nodiscard]] Admission admit(std::int64_t now_us, const GuardSample& sample) noexcept;

  /// Second half: limits the requested force. Without admit() before it, the frames age.
  [[nodiscard]] GuardedForce force(std::int64_t now_us, const WantedForce& wanted) noexcept;

  /// Force zero until rearm().
  void pause() noexcept;
  /// Force zero permanently.
  void stop() noexcept;
  /// Call if the last force was not sent, or was replaced by zero: the next one rises from 0.
  void was_zeroed() noexcept;
  /// Leaves SAFE or a pause; the force then ramps up again. False after stop().
  bool rearm() noexcept;

 private:
  struct State;
  explicit ForceGuard(std::unique_ptr<State> state) noexcept;
  std::unique_ptr<State> state_;
};

// ---- force gate ----------------------------------------------------------------------
// Ensures that one thread at a time commands a force, and that the last packet is zero. The servo
// enters the gate for each packet that it writes. The watchdog, a signal handler, or the end of the
// program shuts the gate and then writes zero. A servo that was inside meanwhile detects that when
// it leaves, and writes zero once more. So for every order of events the last whole packet is zero.

class ForceGate {
 public:
  /// For the servo, before it writes a force. False: it must not write, because the gate is shut or
  /// another thread is inside.
  [[nodiscard]] bool enter() noexcept {
    std::uint32_t open = 0;
    return state_.compare_exchange_strong(open, kInside, std::memory_order_acquire,
                                          std::memory_order_relaxed);
  }

  /// After writing. False: the gate was shut meanwhile, so the servo must write zero again.
  [[nodiscard]] bool leave() noexcept {
    return (state_.fetch_and(~kInside, std::memory_order_release) & kShut) == 0;
  }

  /// Blocks forces from now on; call before writing zero. Async-signal-safe.
  void shut() noexcept { state_.fetch_or(kShut, std::memory_order_acq_rel); }

  /// Permits forces again. Only for the servo, when it runs again after the watchdog has shut the
  /// gate and its guard has processed the late tick. False if shut permanently.
  bool open() noexcept {
    std::uint32_t shut = kShut;
    return state_.compare_exchange_strong(shut, 0, std::memory_order_acq_rel) || shut == 0;
  }

  /// Like shut(), but permanent: open() fails from now on. Async-signal-safe.
  void shut_for_good() noexcept { state_.fetch_or(kShut | kForGood, std::memory_order_acq_rel); }

  /// True while the servo is between enter() and leave().
  [[nodiscard]] bool is_entered() const noexcept {
    return (state_.load(std::memory_order_acquire) & kInside) != 0;
  }
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

/// For signal handlers: shuts the gate permanently, lets the servo finish the packet that it is
/// writing, then writes zero by a function of the device.
/// That function must be async-signal-safe (one write(2) of a frame made beforehand, no lock, no
/// allocation). Give it static storage, and arm it before the force engages.
class EmergencyStop {
 public:
  using WriteZero = void (*)(void* device) noexcept;

  /// `gate` and `device` must outlive every call of fire(). Not for signal handlers. nullptr as
  /// `write_zero` disarms.
  void arm(ForceGate& gate, WriteZero write_zero, void* device) noexcept {
    write_zero_.store(nullptr, std::memory_order_release);
    gate_.store(&gate, std::memory_order_relaxed);
    device_.store(device, std::memory_order_relaxed);
    write_zero_.store(write_zero, std::memory_order_release);
  }

  /// For a signal handler, std::terminate, a destructor. May be called repeatedly. Waits up to
  /// kPacketUs while another thread is inside the gate: its packet would otherwise follow the zero,
  /// if the process ends before that thread leaves.
  void fire() noexcept {
    const WriteZero write_zero = write_zero_.load(std::memory_order_acquire);
    if (write_zero == nullptr) return;
    ForceGate& gate = *gate_.load(std::memory_order_relaxed);
    gate.shut_for_good();
    const std::int64_t end_us = monotonic_us() + kPacketUs;
    while (gate.is_entered() && monotonic_us() < end_us) continue;
    write_zero(device_.load(std::memory_order_relaxed));
  }

  [[nodiscard]] bool is_armed() const noexcept {
    return write_zero_.load(std::memory_order_acquire) != nullptr;
  }

  static constexpr std::int64_t kPacketUs = 1000;

 private:
  static_assert(std::atomic<WriteZero>::is_always_lock_free &&
                std::atomic<void*>::is_always_lock_free);

  std::atomic<WriteZero> write_zero_{nullptr};
  std::atomic<ForceGate*> gate_{nullptr};
  std::atomic<void*> device_{nullptr};
};

// ---- watchdog ------------------------------------------------------------------------
// Runs on a separate thread, because a hanging servo cannot supervise itself. Pure functions of two
// times.

/// The servo stores the time of each tick in an atomic. The watchdog sleeps until next_look_us and
/// shuts the gate temporarily if must_zero is true.
class Watchdog {
 public:
  static constexpr std::int64_t kPatienceUs = 10'000;

  /// True if the last heartbeat is 10 ms old, or so far ahead that one of the clocks is wrong. A
  /// heartbeat slightly ahead arrived after `now_us` was read.
  [[nodiscard]] static constexpr bool must_zero(std::int64_t heartbeat_us,
                                                std::int64_t now_us) noexcept {
    const auto apart =
        heartbeat_us < now_us ? distance(heartbeat_us, now_us) : distance(now_us, heartbeat_us);
    return apart >= static_cast<std::uint64_t>(kPatienceUs);
  }

  /// The time at which this heartbeat becomes too old.
  [[nodiscard]] static constexpr std::int64_t next_look_us(std::int64_t heartbeat_us) noexcept {
    constexpr std::int64_t kLast = INT64_MAX - kPatienceUs;
    return heartbeat_us > kLast ? INT64_MAX : heartbeat_us + kPatienceUs;
  }

 private:
  /// Unsigned, because the difference of two signed numbers can overflow.
  static constexpr std::uint64_t distance(std::int64_t low, std::int64_t high) noexcept {
    return static_cast<std::uint64_t>(high) - static_cast<std::uint64_t>(low);
  }
};

}  // namespace clay::falcon::inline safety
