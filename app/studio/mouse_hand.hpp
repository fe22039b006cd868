#pragma once
// The mouse as a device without motors, in the frame of the wheel. The window sets a target for the
// tool; the device moves towards it no faster than a hand.

#include "app/servo/clock.hpp"
#include "claystack/falcon/device.hpp"
#include "claystack/servo/servo.hpp"
#include "core/snapshot.hpp"

#include <atomic>
#include <glm/vec3.hpp>

namespace clay::studio {

/// Maximum speed of the tool in clay and in air [mm/s].
inline constexpr double kPressingMmPerS = 80.0, kReachingMmPerS = 400.0;

struct MouseAim {
  glm::dvec3 place_mm{0.0};  ///< target of the tool, in the frame of the wheel
  double speed_mm_s = kPressingMmPerS;
};

class MouseDevice final : public falcon::HapticDevice {
 public:
  /// `clock`: the clock of the servo; it must outlive this object.
  explicit MouseDevice(servo::Clock& clock) noexcept : clock_(clock) {}

  /// Settings of a servo for this device: device and wheel share one frame.
  [[nodiscard]] static servo::LiveSettings servo_settings() noexcept;

  /// Start position of the tool for the next servo. Not while a servo runs.
  void begin_at(const glm::dvec3& place_mm) noexcept;
  /// Called by the thread of the window, at any time.
  void aim(const MouseAim& aim) noexcept { aim_.write(aim); }

  [[nodiscard]] const falcon::DeviceInfo& info() const noexcept override { return info_; }
  falcon::DeviceResult<void> open() override;
  falcon::DeviceSample read(std::int64_t wait_us) noexcept override;
  void write(const glm::dvec3&) noexcept override {}
  void zero() noexcept override {}
  void stop() noexcept override {}
  [[nodiscard]] falcon::DeviceError problem() const override { return {}; }
  [[nodiscard]] falcon::DeviceCounters counters() const noexcept override { return {}; }

 private:
  servo::Clock& clock_;
  falcon::DeviceInfo info_{.name = "Mouse",
                           .place = "window",
                           .can_push = false,
                           .force_limit_n = 0.0,
                           .half_workspace_mm = glm::dvec3(1000.0),
                           .rate_hz = 1000.0};
  Snapshot<MouseAim> aim_;
  glm::dvec3 place_mm_{0.0};
  std::int64_t last_us_ = -1;  // of the last sample; below 0: none since begin_at
};

}  // namespace clay::studio
