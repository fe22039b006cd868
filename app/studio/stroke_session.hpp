#pragma once
// One tool in the clay, from start to end: the wheel, the device and the servo between them.

#include "app/servo/servo.hpp"
#include "claystack/engine/wheel.hpp"
#include "claystack/falcon/device.hpp"

#include <cstdint>
#include <memory>
#include <optional>

namespace clay::studio {

/// How the servo is scheduled.
enum class Pace {
  thread,     ///< on its own thread, with the system clock
  real_time,  ///< the same with real-time priority, if permitted: for devices with motors
  stepped,    ///< on the caller's thread, in `advance`
};

class StrokeSession {
 public:
  /// Device, clock, recorder and trace must outlive it; the device is open. Errors as in
  /// servo::ServoLoop::build.
  static Result<std::unique_ptr<StrokeSession>> begin(
      Wheel wheel, falcon::HapticDevice& device, servo::Clock& clock, servo::Recorder* recorder,
      servo::TickTrace* trace, const servo::LiveSettings& settings, Pace pace);
  ~StrokeSession();
  StrokeSession(const StrokeSession&) = delete;
  StrokeSession& operator=(const StrokeSession&) = delete;

  /// With Pace::stepped: ticks until the clock reaches `until_ns`. Otherwise does nothing.
  void advance(std::int64_t until_ns);
  bool command(const servo::Command& command) noexcept;
  /// False once it has ended by itself, because the clay fell or the device was lost.
  [[nodiscard]] bool running() const noexcept;

  [[nodiscard]] const servo::LiveStatus& status() noexcept { return view().status.newest(); }
  /// Null if there is no newer profile than the last one returned.
  [[nodiscard]] const servo::LiveProfile* new_profile() noexcept;

  /// Ends the servo, waits for the last tick and leaves the device without force. After that the
  /// caller may read the wheel.
  servo::Ending end();
  [[nodiscard]] const Wheel& wheel() const noexcept { return wheel_; }
  [[nodiscard]] const servo::ServoLoop& loop() const noexcept { return *loop_; }
  /// The scheduling that the system granted, once the servo has ended.
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
  std::unique_ptr<servo::Servo> servo_;  // with Pace::thread or real_time
  // with Pace::stepped
  falcon::ForceGate gate_;
  servo::Commands commands_;
  servo::LiveView view_;
  std::atomic<std::int64_t> heartbeat_us_{0};
  servo::Ending ending_ = servo::Ending::none;
};

}  // namespace clay::studio
