#pragma once
// A tool in the clay, from when it is taken to when it is let go: the wheel, the device and the
// servo between them.

#include "app/servo/servo.hpp"
#include "claystack/engine/wheel.hpp"
#include "claystack/falcon/device.hpp"

#include <cstdint>
#include <memory>
#include <optional>

namespace clay::studio {

/// How the servo gets its time.
enum class Pace {
  thread,     ///< a thread of its own, on the machine's clock
  real_time,  ///< the same, with all the system gives a servo: for devices with motors
  stepped,    ///< on the caller's thread, as far as `advance` says
};

class StrokeSession {
 public:
  /// Device, clock, recorder and trace outlive it; the device is open. Errors as
  /// servo::ServoLoop::build.
  static Result<std::unique_ptr<StrokeSession>> begin(
      Wheel wheel, falcon::HapticDevice& device, servo::Clock& clock, servo::Recorder* recorder,
      servo::TickTrace* trace, const servo::LiveSettings& settings, Pace pace);
  ~StrokeSession();
  StrokeSession(const StrokeSession&) = delete;
  StrokeSession& operator=(const StrokeSession&) = delete;

  /// Stepped: ticks until the clock stands at `until_ns`. Else nothing.
  void advance(std::int64_t until_ns);
  bool command(const servo::Command& command) noexcept;
  /// False once it has ended by itself: the clay fell, the device went.
  [[nodiscard]] bool running() const noexcept;

  [[nodiscard]] const servo::LiveStatus& status() noexcept { return view().status.newest(); }
  /// Nothing where there is no newer one than the last.
  [[nodiscard]] const servo::LiveProfile* new_profile() noexcept;

  /// Ends it, waits for the last tick, and is free of force. The wheel is the caller's to look at
  /// from then on.
  servo::Ending end();
  [[nodiscard]] const Wheel& wheel() const noexcept { return wheel_; }
  [[nodiscard]] const servo::ServoLoop& loop() const noexcept { return *loop_; }
  /// What the system gave the servo, once it has ended.
  [[nodiscard]] servo::Realtime realtime() const {
    return servo_ ? servo_->realtime() : servo::Realtime{};
  }

 private:
  StrokeSession(Wheel wheel, Pace pace) : wheel_(std::move(wheel)), pace_(pace) {}
  [[nodiscard]] servo::LiveView& view() noexcept { return servo_ ? servo_->view() : view_; }

  Wheel wheel_;
  Pace pace_;
  servo::Clock* clock_ = nullptr;
  std::optional<servo::ServoLoop> loop_;
  std::unique_ptr<servo::Servo> servo_;  // with a thread
  // Stepped.
  falcon::ForceGate gate_;
  servo::Commands commands_;
  servo::LiveView view_;
  std::atomic<std::int64_t> heartbeat_us_{0};
  servo::Ending ending_ = servo::Ending::none;
};

}  // namespace clay::studio
