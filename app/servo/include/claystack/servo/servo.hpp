#pragma once
// The servo: a pot thrown live with a haptic arm. It joins a wheel of claystack::engine to a device
// of claystack::falcon: 1000 times a second it reads the hand, moves the tool, deforms the clay and
// sends a force back, on its own thread and through the force guard, supervised by a watchdog.
// docs/servo.md describes the tick, docs/force-guard.md the guard.
//
//   auto live = clay::servo::LiveThrow::build({.wheel = *wheel, .device = *device, .scene = scene},
//                                             {.seconds = 2.0});
//   if (!live->start()) return 1;
//   const clay::servo::Ending ending = live->join();

#include "claystack/core/result.hpp"
#include "claystack/engine/files.hpp"
#include "claystack/engine/wheel.hpp"
#include "claystack/falcon/device.hpp"
#include "claystack/falcon/falcon_device.hpp"
#include "claystack/falcon/guard.hpp"
#include "claystack/falcon/passivity.hpp"

#include <array>
#include <cstddef>
#include <cstdint>
#include <glm/vec3.hpp>
#include <memory>
#include <string>

namespace clay::servo {

// ---- settings ------------------------------------------------------------------------

/// The side of the pot on which the middle of the workspace lies.
enum class Side { right, left, front };

struct MappingSettings {
  /// Travel of the tool per travel of the hand, 0.1 to 10. With 1.6, 96 mm of a Falcon reach 154
  /// mm.
  double scale = 1.6;
  double force_gain = 0.0;  ///< force at the hand per force at the tool, up to 10; 0: 1 / scale
  Side side = Side::right;
  double reach_mm = 60.0;   ///< distance of the workspace's middle from the axis, 0 to 1000
  double height_mm = 75.0;  ///< its height above the wheel head, -1000 to 1000
  bool flip_x = false, flip_y = false, flip_z = false;
  friend bool operator==(const MappingSettings&, const MappingSettings&) = default;
};

/// Bits of DeviceSample::buttons; 0: no such button.
struct ButtonMap {
  unsigned clutch = 0, trim = 0;  ///< active while held
  unsigned wider = 0,
           narrower = 0;  ///< change the gap by kGapStepMm per press, repeated while held
};
inline constexpr ButtonMap kFalconButtons{falcon::kButtonCentre, falcon::kButtonForward,
                                          falcon::kButtonPlus, falcon::kButtonMinus};
inline constexpr ButtonMap kTwoButtons{2, 1, 0, 0};  ///< a controller with two buttons
inline constexpr double kGapStepMm = 0.5, kWidestGapMm = 100.0;
/// Settings of a servo, apart from the wheel and the device.
struct LiveSettings {
  double rate_hz = 1000.0;  ///< rate of device and force, 400 to 4000; slower frames count as stale
  double clay_rate_hz = 0.0;  ///< ticks of the clay, 20 to rate_hz; 0: rate_hz
  double seconds = 0.0;       ///< counted from the first valid sample, pauses included; 0: no limit
  /// If `seconds` is set: the longest wait for the first valid sample, for example while the device
  /// is not homed. At least `seconds`.
  double patience_s = 60.0;
  double gap_mm = 0.0;  ///< gap of the poses, if the scene allows a pinch; up to kWidestGapMm
  MappingSettings mapping;
  ButtonMap buttons = kFalconButtons;
  falcon::GuardSettings guard;  ///< its period is set from rate_hz
  /// Model of the arm; it limits the stiffness of the contact. Its rate is the highest at which the
  /// device measures: a servo with a higher rate_hz gets no newer samples.
  falcon::SampledLoop arm{1000.0, 0.1, 0.002, 1};
  double encoder_step_mm = 0.05;  ///< of the Falcon in the middle of its workspace
};

/// Errors name the setting. Mapping and guard are checked when they are built.
Result<void> check(const LiveSettings& settings);

/// Refuses a scene whose contact is stiffer than the arm of `settings` can render safely; names the
/// setting and the accepted values.
Result<void> check_stiffness(const SceneSpec& scene, const LiveSettings& settings);

/// Lowers the stiffness of the scene's contact to the largest that the arm of `settings` can render
/// safely; returns the remaining fraction, 1 if it was soft enough. The pot does not depend on it:
/// a softened scene replays to the same pot. Build the wheel from the softened scene.
Result<double> soften(SceneSpec& scene, const LiveSettings& settings);

// ---- commands ------------------------------------------------------------------------

enum class CommandKind {
  clutch,  ///< value 0 releases, any other holds; also for trim and pause
  trim,
  pause,
  gap,    ///< value: mm, 0 to kWidestGapMm; 0: one tool
  zero,   ///< no force and no deformation until `rearm`, or until the clutch is released
  rearm,  ///< restores the force after `zero` or a safe state whose cause is gone
  stop,
};

struct Command {
  CommandKind kind = CommandKind::stop;
  double value = 0.0;
};

// ---- status --------------------------------------------------------------------------

/// The reason why the servo ended.
enum class Ending {
  none,         ///< still running
  stopped,      ///< by command or signal
  time_up,      ///< `seconds` are over, or no valid sample arrived in time
  device_lost,  ///< HapticDevice::problem has the reason
  collapsed,    ///< the pot collapsed
};

/// The state after a tick.
struct LiveStatus {
  double time_s = 0.0;  ///< since the first valid sample
  Ending ending = Ending::none;
  falcon::DeviceState device = falcon::DeviceState::closed;
  falcon::GuardState guard = falcon::GuardState::idle;
  falcon::SafeCause cause = falcon::SafeCause::none;
  falcon::PassivityState passivity = falcon::PassivityState::watching;
  bool clutched = false, paused = false, contact = false;
  bool ring_limit = false;  ///< the stack cannot grow further: raise lump.max_rings
  glm::dvec3 tool_mm{0.0};  ///< position of the tool, in the wheel's frame
  double gap_mm = 0.0;      ///< gap of a pinch; 0: one tool, or the gap of the scene
  glm::dvec3 clay_n{0.0};   ///< force of the clay on the tool, before mapping and guard
  glm::dvec3 force_n{0.0};  ///< force sent, in the device's frame
  double force_gain = 0.0;  ///< GuardedForce::gain
  /// Rate of the samples, if it is clearly below the rate of servo and arm, so that the contact is
  /// displayed softer; 0: it is not.
  double slow_hz = 0.0;
  /// Time in which the device answers a force, if it is longer than LiveSettings::arm states, so
  /// that the contact is displayed softer; 0: it is not.
  double answer_ms = 0.0;
  double volume_error = 0.0;  ///< Ledger::volume_error [quanta]; exact below 2^53
  double imbalance = 0.0;     ///< Ledger::imbalance, clay unaccounted for [quanta]
  double stack_mm3 = 0.0, trimmed_mm3 = 0.0, outside_mm3 = 0.0;  ///< as in Ledger
  double height_mm = 0.0;                                        ///< of the clay
  std::uint64_t ticks = 0, poses = 0, missed = 0;
  std::int64_t late_ns = 0;  ///< lateness of this tick
};

/// Outline of the clay, bottom to top: radii of at most kRows rings, evenly chosen if there are
/// more.
struct LiveProfile {
  static constexpr std::size_t kRows = 2048;
  struct Row {
    float outer_mm = 0.0f, inner_mm = 0.0f;
  };
  std::array<Row, kRows> rows{};
  std::size_t size = 0;    ///< rows in use
  double height_mm = 0.0;  ///< of the whole stack, crown included
  double crown_mm = 0.0;   ///< height of the crown
  double time_s = 0.0;     ///< time of its tick
};

/// The response of the system to the request for real-time scheduling.
struct Realtime {
  bool fifo = false;  ///< SCHED_FIFO
  bool memory_locked = false;
  bool exact_sleep = false;  ///< timer slack of 1 ns
  std::string missing;       ///< refused requests, their reason and the remedy; empty: none
};

// ---- clock ---------------------------------------------------------------------------

/// The servo's only source of time, so that a program can run it on another clock. Two threads call
/// it at once, the servo and its watchdog, except with Pace::stepped.
class Clock {
 public:
  Clock() = default;
  Clock(const Clock&) = delete;
  Clock& operator=(const Clock&) = delete;
  virtual ~Clock() = default;

  /// [ns]; in whole microseconds the time of the device's samples.
  [[nodiscard]] virtual std::int64_t now_ns() noexcept = 0;
  [[nodiscard]] std::int64_t now_us() noexcept { return now_ns() / 1000; }

  /// Returns at once if that time has passed.
  virtual void sleep_until_ns(std::int64_t time_ns) noexcept = 0;

  /// The same as exactly as possible, for one thread. Returns the delay of the end of the sleep
  /// within it [ns].
  virtual std::int64_t wake_at_ns(std::int64_t time_ns) noexcept {
    sleep_until_ns(time_ns);
    return 0;
  }
};

// ---- live throw ----------------------------------------------------------------------

/// The parts of a live throw. All must outlive it.
struct ThrowParts {
  Wheel& wheel;
  falcon::HapticDevice& device;  ///< open
  const SceneSpec& scene;        ///< the scene of the wheel; read by build() only
  /// A session file to record the poses to, which replays to the same pot; empty: none.
  std::string session_path = {};
  /// hash_of() the scene as its file has it, for the session; 0: of `scene`. soften() changes the
  /// hash of a scene, but not the pot to which the session replays.
  std::uint64_t scene_hash = 0;
  PoseSink* sink = nullptr;  ///< receives the poses instead of a session file
  Clock* clock = nullptr;    ///< null: CLOCK_MONOTONIC
};

/// The thread that ticks.
enum class Pace {
  real_time,  ///< its own, with SCHED_FIFO and locked memory requested: for devices with motors
  thread,     ///< its own, scheduled like any other
  stepped,    ///< the caller's, within advance() and join(); without a watchdog
};

/// Of a recording.
struct Recorded {
  std::uint64_t poses = 0;
  /// The last ones, if the disk was too slow or the session is full: the recording ends before.
  std::uint64_t lost = 0;
};

/// The servo thread, its watchdog and the force guard. Every force passes the guard: it is finite,
/// at most the limit, zero within 10 ms of a fault, and zero at the end. The servo thread allocates
/// nothing and takes no lock, apart from the internal work of libusb and hidapi.
class LiveThrow {
 public:
  /// Refuses settings out of range, by name; a scene whose contact is stiffer than the arm can
  /// render safely (see soften()); a session that cannot be recorded.
  static Result<LiveThrow> build(const ThrowParts& parts, const LiveSettings& settings);
  LiveThrow(LiveThrow&&) noexcept;
  LiveThrow& operator=(LiveThrow&&) noexcept;
  /// Stops and waits for the end.
  ~LiveThrow();

  /// Starts the servo; one at a time in a process, because signal handlers end the force of one.
  /// After join() returned device_lost and the device was opened again, continues, with the force
  /// ramped up from zero. Errors: another servo runs (`bad_input`), or the system starts no thread
  /// (`io`); nothing runs then. A servo of this object that still runs is stopped first.
  Result<void> start(Pace pace = Pace::real_time);

  /// Pace::stepped: ticks until the clock reaches `until_ns`, or to the end. Otherwise nothing.
  void advance(std::int64_t until_ns) noexcept;

  /// For one other thread. False: the queue is full, or start() was not called yet.
  bool command(const Command& command) noexcept;

  /// The newest complete values, without a lock. For one thread; valid until the next call.
  [[nodiscard]] const LiveStatus& status() noexcept;
  [[nodiscard]] const LiveProfile& profile() noexcept;
  /// The newest profile. Null if there is none since the last call of new_profile() or profile().
  [[nodiscard]] const LiveProfile* new_profile() noexcept;
  [[nodiscard]] bool running() const noexcept;

  /// Waits for the end: time, `stop`, a lost device or a collapse. The device then has zero force,
  /// and the wheel may be read.
  Ending join();
  /// Ends it, whether or not the command queue has room, and waits like join().
  Ending stop();
  /// After join().
  [[nodiscard]] const Realtime& realtime() const noexcept;
  /// After the last join(): completes the recorded session under its name; does nothing without a
  /// recording. Errors: the disk was full or removed, or those of the sink. See recorded().lost
  /// too.
  Result<void> finish_recording();
  /// Nothing without a recording.
  [[nodiscard]] Recorded recorded() const noexcept;

  /// Ends the force of the running servo immediately and permanently. Async-signal-safe: for
  /// handlers of SIGINT, SIGSEGV and std::terminate.
  static void end_force() noexcept;

 private:
  friend struct LiveMeasures;  // for the reports and plots of the project's own programs
  struct State;
  explicit LiveThrow(std::unique_ptr<State> state) noexcept;
  std::unique_ptr<State> state_;
};

}  // namespace clay::servo
