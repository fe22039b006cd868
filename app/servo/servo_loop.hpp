#pragma once
// One tick of throwing: device, mapping, guard, clay, force, guard, device. It runs on the caller's
// thread and on a given clock; it neither allocates nor throws. docs/servo.md describes the threads
// around it and the faults that it handles.

#include "app/servo/clock.hpp"
#include "app/servo/controls.hpp"
#include "app/servo/live_view.hpp"
#include "app/servo/mapping.hpp"
#include "app/servo/recorder.hpp"
#include "app/servo/tick_trace.hpp"
#include "claystack/engine/wheel.hpp"
#include "claystack/falcon/device.hpp"
#include "claystack/falcon/guard.hpp"
#include "claystack/servo/servo.hpp"

#include <atomic>
#include <cstdint>

namespace clay::servo {

/// Plays and records poses, or only computes the contact force.
///
/// If the clay rate is below the servo rate, the first accepted sample of each clay period deforms
/// the clay, and only that pose is recorded. In the ticks between, the force is computed at the
/// current position of the tool from the unchanged clay: contact and spring, no removal, no flow.
class LiveClay {
 public:
  /// `wheel` and `recorder` must outlive it. `period_us`: of the clay; 0: every sample deforms it.
  /// `recorder` null: nothing is recorded.
  LiveClay(Wheel& wheel, Recorder* recorder, std::int64_t period_us) noexcept
      : wheel_(wheel), recorder_(recorder), period_us_(period_us) {}

  /// The clay's force [N] on the tool at `pose`, of a sample that may deform it. Poses that the
  /// wheel refuses, or whose time does not advance, are neither played nor recorded.
  [[nodiscard]] StepReport meet(const Pose& pose) noexcept;

  [[nodiscard]] const Wheel& wheel() const noexcept { return wheel_; }
  [[nodiscard]] std::uint64_t poses() const noexcept { return poses_; }  ///< played

 private:
  Wheel& wheel_;
  Recorder* recorder_;
  std::int64_t period_us_;
  std::int64_t due_us_ = 0, last_us_ = -1;
  std::uint64_t poses_ = 0;
};

/// The parts used by the loop. All must outlive it.
struct LoopParts {
  Wheel& wheel;
  falcon::HapticDevice& device;
  Clock& clock;
  Recorder* recorder = nullptr;  ///< null: nothing is recorded
  TickTrace* trace = nullptr;    ///< null: no plot of ticks
};

class ServoLoop {
 public:
  /// Errors name the setting.
  static Result<ServoLoop> build(const LoopParts& parts, const LiveSettings& settings);

  /// Before the first tick, and after the device was reopened: the force ramps up again from zero,
  /// and the session continues. A pause, and a force that a command set to zero, remain.
  void start() noexcept;

  /// Sleeps until the deadline, then ticks. Any result but `none` ends the loop. `heartbeat_us` is
  /// read by the watchdog.
  Ending tick(falcon::ForceGate& gate, Commands& commands, LiveView& view,
              std::atomic<std::int64_t>& heartbeat_us) noexcept;

  // Only while no thread ticks.
  [[nodiscard]] const ServoTiming& timing() const noexcept { return timing_; }
  [[nodiscard]] const GuardEvents& events() const noexcept { return events_; }
  [[nodiscard]] const LiveStatus& status() const noexcept { return status_; }
  void count_watchdog(std::uint64_t times) noexcept { events_.watchdog += times; }

 private:
  ServoLoop(const LoopParts& parts, const LiveSettings& settings, const Mapping& mapping,
            falcon::ForceGuard guard, const falcon::PassivitySettings& passivity,
            falcon::PassivityController controller);

  void count_delay() noexcept;
  void apply(const falcon::DeviceSample& sample, std::int64_t now_us, Commands& commands) noexcept;
  void follow(const falcon::DeviceSample& sample, std::int64_t now_us) noexcept;
  void send(falcon::ForceGate& gate) noexcept;
  void count_events() noexcept;
  void keep_time(std::int64_t late_ns, std::int64_t begun_ns,
                 const falcon::DeviceSample& sample) noexcept;
  [[nodiscard]] Ending ending(const falcon::ForceGate& gate) const noexcept;
  [[nodiscard]] bool time_is_up() const noexcept;
  void publish(LiveView& view, std::int64_t late_ns) noexcept;

  LoopParts parts_;
  double seconds_, patience_s_;
  Mapping mapping_;
  Controls controls_;
  falcon::ForceGuard guard_;
  falcon::PassivitySettings passivity_;  // as stated
  HandForce hand_;
  LiveClay clay_;
  Pacer pacer_;

  bool held_ = false;          // clutched or paused: the tool does not touch the clay
  bool zeroed_ = false;        // the force, by command, until a rearm or the clutch's release
  bool recentre_ = false;      // at the next accepted sample: the clutch was released
  bool thrown_ = false;        // a sample was accepted
  std::int64_t first_us_ = 0;  // time of the first accepted sample
  std::int64_t started_ns_ = 0;
  std::int64_t last_begun_ns_ = 0;
  glm::dvec3 tool_mm_{0.0};
  falcon::WantedForce wanted_;
  falcon::GuardedForce guarded_;
  std::uint32_t flags_before_ = falcon::kGuardClock;  // the first tick has no previous time
  ServoTiming timing_;
  GuardEvents events_;
  LiveStatus status_;
};

}  // namespace clay::servo
