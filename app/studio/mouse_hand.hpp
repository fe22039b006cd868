#pragma once
// The mouse as a hand at the wheel: a device without motors whose frame is the wheel's own. The
// window says where the tool should go; the servo moves it there, no faster than a hand would.

#include "app/servo/clock.hpp"
#include "claystack/falcon/device.hpp"
#include "claystack/servo/servo.hpp"
#include "core/snapshot.hpp"

#include <atomic>
#include <glm/vec3.hpp>

namespace clay::studio {

/// In clay a hand presses this fast [mm/s]; beside it, it may hurry.
inline constexpr double kPressingMmPerS = 80.0, kReachingMmPerS = 400.0;

struct MouseAim {
  glm::dvec3 place_mm{0.0};  ///< where the tool should go, on the wheel
  double speed_mm_s = kPressingMmPerS;
};

class MouseDevice final : public falcon::HapticDevice {
 public:
  /// `clock` is the servo's, and outlives this.
  explicit MouseDevice(servo::Clock& clock) noexcept : clock_(clock) {}

  /// A servo for it: the mouse's millimetres are the wheel's.
  [[nodiscard]] static servo::LiveSettings servo_settings() noexcept;

  /// The tool stands here when the next servo starts. Not while one runs.
  void begin_at(const glm::dvec3& place_mm) noexcept;
  /// From the window's thread, at any time.
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
