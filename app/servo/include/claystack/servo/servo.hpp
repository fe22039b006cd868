#pragma once
// The servo: a pot thrown live with a haptic arm. It joins a wheel of claystack::engine to a device
// of claystack::falcon: 1000 times a second it reads the hand, moves the tool, deforms the clay and
// sends a force back, on a thread of its own and through the force guard, with a watchdog beside
// it. docs/servo.md describes the tick, docs/force-guard.md the guard.
//
//   auto live = clay::servo::LiveThrow::build({.wheel = *wheel, .device = *device, .scene = scene},
//                                             {.seconds = 2.0});
//   live->start();
//   const clay::servo::Ending ending = live->join();

#include "claystack/core/result.hpp"
#include "claystack/engine/wheel.hpp"
#include "claystack/falcon/device.hpp"
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

/// Where the hand works; the middle of the workspace lies there, at half the height.
enum class Side { right, left, front };

struct MappingSettings {
  /// Wheel mm to a mm of the hand, 0.1 to 10. 1.6 makes 154 mm of a Falcon's 96.
  double scale = 1.6;
  double force_gain = 0.0;  ///< N at the hand to a N at the tool, to 10; 0: 1 / scale
  Side side = Side::right;
  double reach_mm = 60.0;   ///< of the workspace's middle from the axis, 0 to 1000
  double height_mm = 75.0;  ///< and above the wheel head, -1000 to 1000
  bool flip_x = false, flip_y = false, flip_z = false;
  friend bool operator==(const MappingSettings&, const MappingSettings&) = default;
};

/// Bits of DeviceSample::buttons; 0 where there is no such button.
struct ButtonMap {
  unsigned clutch = 0, trim = 0;  ///< for as long as they are held
  unsigned wider = 0,
           narrower = 0;  ///< the gap, by kGapStepMm at each press, and on while it is held
};
inline constexpr ButtonMap kFalconButtons{4, 2, 1, 8};  ///< centre, forward, plus, minus
inline constexpr ButtonMap kTwoButtons{2, 1, 0, 0};     ///< of a controller with two
inline constexpr double kGapStepMm = 0.5, kWidestGapMm = 100.0;
/// What a servo is made of beside the wheel and the device.
struct LiveSettings {
  double rate_hz = 1000.0;  ///< of device and force: 400, where frames grow stale, to 4000
  double clay_rate_hz =
      0.0;               ///< 20, as the engine counts no step for longer, to the rate; 0: the rate
  double seconds = 0.0;  ///< from the first sample believed, pauses and all; 0: until asked to end
  /// Where `seconds` are set: how long that sample is waited for, as of a device that nobody homes;
  /// or `seconds`, where that is longer.
  double patience_s = 60.0;
  double gap_mm = 0.0;  ///< of poses, where the scene lets them pinch, to kWidestGapMm
  MappingSettings mapping;
  ButtonMap buttons = kFalconButtons;
  falcon::GuardSettings guard;  ///< its period follows from the rate
  /// The arm as the passivity controller counts on it; its rate follows from ours.
  falcon::SampledLoop arm{1000.0, 0.1, 2.0, 1};
  double encoder_step_m = 5e-5;  ///< the Falcon's, in the middle of its workspace
};

/// Errors name the setting. Mapping, guard and arm are checked where they are built.
Result<void> check(const LiveSettings& settings);

/// Lowers the stiffness of the scene's contact to what the arm of `settings` can render safely;
/// returns the part of it that is left, 1 where it was soft enough. The pot does not depend on it:
/// a softened scene replays to the same pot. Build the wheel from the softened scene.
Result<double> soften(SceneSpec& scene, const LiveSettings& settings);

// ---- commands ------------------------------------------------------------------------

enum class CommandKind {
  clutch,  ///< value 0 lets go, any other holds; so of trim and pause
  trim,
  pause,
  gap,    ///< value: mm, 0 to kWidestGapMm; 0: one tool
  zero,   ///< no force, and the clay is left alone, until `rearm`
  rearm,  ///< force again after `zero` or when the guard went safe, once the cause is gone
  stop,
};

struct Command {
  CommandKind kind = CommandKind::stop;
  double value = 0.0;
};

// ---- status --------------------------------------------------------------------------

/// Why the servo no longer ticks.
enum class Ending {
  none,         ///< it does
  stopped,      ///< asked to, by command or signal
  time_up,      ///< the seconds asked for are over, or no sample came to begin them
  device_lost,  ///< HapticDevice::problem tells
  collapsed,    ///< nothing is left to throw
};

/// A tick as it was.
struct LiveStatus {
  double time_s = 0.0;  ///< of throwing: since the first sample that was believed
  Ending ending = Ending::none;
  falcon::DeviceState device = falcon::DeviceState::closed;
  falcon::GuardState guard = falcon::GuardState::idle;
  falcon::SafeCause cause = falcon::SafeCause::none;
  falcon::PassivityState passivity = falcon::PassivityState::watching;
  bool clutched = false, paused = false, contact = false;
  bool ring_limit = false;    ///< clay waits above the top: raise lump.max_rings
  glm::dvec3 tool_mm{0.0};    ///< on the wheel
  double gap_mm = 0.0;        ///< of a pinch; 0: one tool, or the scene's own gap
  glm::dvec3 clay_n{0.0};     ///< of the clay on the tool, whatever the device can show of it
  glm::dvec3 force_n{0.0};    ///< sent, in the device's frame
  double force_gain = 0.0;    ///< part of it that is earned
  double volume_error = 0.0;  ///< clay unaccounted for [quanta]; exact below 2^53
  double imbalance = 0.0;     ///< the same with what is outside: Ledger::imbalance
  double stack_mm3 = 0.0, trimmed_mm3 = 0.0, outside_mm3 = 0.0;  ///< of the clay, as in Ledger
  double height_mm = 0.0;                                        ///< of the clay
  std::uint64_t ticks = 0, poses = 0, missed = 0;
  std::int64_t late_ns = 0;  ///< of this tick
};

/// The clay in outline, bottom to top: radii of at most kRows rings, evenly chosen where there are
/// more.
struct LiveProfile {
  static constexpr std::size_t kRows = 2048;
  struct Row {
    float outer_mm = 0.0f, inner_mm = 0.0f;
  };
  std::array<Row, kRows> rows{};
  std::size_t size = 0;    ///< rows in use
  double height_mm = 0.0;  ///< of the whole stack, crown and all
  double crown_mm = 0.0;   ///< of that, the height of the crown
  double time_s = 0.0;     ///< of the tick that it was seen in
};

/// What the system granted when it was asked for real-time scheduling.
struct Realtime {
  bool asked = false;
  bool fifo = false;  ///< SCHED_FIFO
  bool memory_locked = false;
  bool exact_sleep = false;  ///< timer slack of 1 ns
  std::string missing;       ///< what was not given, why, and what would help; empty: nothing
};

// ---- live throw ----------------------------------------------------------------------

/// What a live throw works on. All outlive it.
struct ThrowParts {
  Wheel& wheel;
  falcon::HapticDevice& device;  ///< open
  const SceneSpec& scene;        ///< of the wheel; read by build() only
  /// A session file to record the poses to, which replays to the same pot; empty: none.
  std::string session_path = {};
};

/// The servo thread, its watchdog and the force guard, ready to run. Nothing reaches the device but
/// through the guard: finite, at most the limit, zero within 10 ms of a fault, and zero as the last
/// word. The servo thread allocates nothing and takes no lock.
class LiveThrow {
 public:
  /// Refuses settings out of range, by name; a scene whose contact is stiffer than the arm can
  /// render safely (see soften()); a session that cannot be recorded.
  static Result<LiveThrow> build(const ThrowParts& parts, const LiveSettings& settings);
  LiveThrow(LiveThrow&&) noexcept;
  LiveThrow& operator=(LiveThrow&&) noexcept;
  /// Stops, and waits for the end.
  ~LiveThrow();

  /// Begins to tick; after join() with device_lost and a device that was opened again, goes on: the
  /// force ramps up again from zero. `realtime`: ask the system for SCHED_FIFO and locked memory.
  void start(bool realtime = true);

  /// From one other thread. False: too many commands wait.
  bool command(const Command& command) noexcept;

  /// The newest whole values, without a lock. For one thread; valid until the next call.
  [[nodiscard]] const LiveStatus& status() noexcept;
  [[nodiscard]] const LiveProfile& profile() noexcept;
  [[nodiscard]] bool running() const noexcept;

  /// Waits until the servo has ended: by the time set, by `stop`, by a lost device or a collapse.
  /// The device then gives no force. The wheel may be read from now on.
  Ending join();
  /// After join().
  [[nodiscard]] const Realtime& realtime() const noexcept;
  /// After the last join(): the recorded session is complete and has its name. Nothing to do where
  /// none is recorded. Errors: the disk was too slow, full or gone.
  Result<void> finish_recording();

  /// Ends the force of the servo that runs, at once and for good. Async-signal-safe: for handlers
  /// of SIGINT, SIGSEGV and std::terminate.
  static void end_force() noexcept;

 private:
  struct State;
  explicit LiveThrow(std::unique_ptr<State> state) noexcept;
  std::unique_ptr<State> state_;
};

}  // namespace clay::servo
