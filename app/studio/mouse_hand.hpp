#pragma once
// The mouse as a device without motors, in the frame of the wheel. The window sets a target for the
// tool; a spring pulls the tool there, no faster than a hand, and into the clay no further in a
// turn of the wheel than the bite of the hand, nor deeper than clay gives way. So the tool stops at
// clay that is too hard for the hand, or bends the wall; it never jumps through the wall.

#include "app/servo/clock.hpp"
#include "claystack/engine/clay.hpp"
#include "claystack/engine/tool.hpp"
#include "claystack/falcon/device.hpp"
#include "claystack/servo/servo.hpp"
#include "core/snapshot.hpp"

#include <atomic>
#include <glm/vec3.hpp>
#include <optional>

namespace clay::studio {

/// Maximum speed of the tool in clay and in air [mm/s].
inline constexpr double kPressingMmPerS = 80.0, kReachingMmPerS = 400.0;

struct MouseAim {
  glm::dvec3 place_mm{0.0};  ///< target of the tool, in the frame of the wheel
  double speed_mm_s = kPressingMmPerS;
  double bite_mm = 0.0;  ///< maximum advance of the whole tool into clay per turn
};

/// The clay that resists the hand.
struct Resistance {
  const ClayStack* clay =
      nullptr;  ///< of the wheel of the servo, which reads the mouse; null: none
  const Tool* tool = nullptr;
  double wheel_rpm = 0.0;
  /// Height of a pot that stands upside down; then `tool` is turned, too.
  std::optional<double> turned_mm{};
};

class MouseDevice final : public falcon::HapticDevice {
 public:
  /// `clock`: the clock of the servo; it must outlive this object.
  explicit MouseDevice(servo::Clock& clock) noexcept : clock_(clock) {}

  /// Settings of a servo for this device: device and wheel share one frame.
  [[nodiscard]] static servo::LiveSettings servo_settings() noexcept;

  /// Start position of the tool for the next servo. Not while a servo runs.
  void begin_at(const glm::dvec3& place_mm) noexcept;
  /// The clay that the tool meets. Not while a servo runs; its clay and tool must outlive that
  /// servo.
  void meet(const Resistance& resistance) noexcept { resistance_ = resistance; }
  /// Length of the spring, from the tool to its target [mm]. For any thread.
  [[nodiscard]] double stretch_mm() const noexcept {
    return stretch_mm_.load(std::memory_order_relaxed);
  }
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
  /// Overlap of tool and clay in the section: its area, and the integral of depth^2 / 2 over the
  /// height. The slope of that integral along a motion outward or inward measures the clay in the
  /// way of the motion.
  struct Overlap {
    double area_mm2 = 0.0, energy_mm3 = 0.0;
  };
  /// A height of the hand in the frame of the stack.
  [[nodiscard]] double upright(double y_mm) const noexcept {
    return resistance_.turned_mm ? *resistance_.turned_mm - y_mm : y_mm;
  }
  [[nodiscard]] Overlap overlap(const glm::dvec3& place_mm) const noexcept;
  [[nodiscard]] double tool_height_mm() const noexcept {
    return resistance_.tool->high() - resistance_.tool->low();
  }
  [[nodiscard]] glm::dvec3 unstopped(const glm::dvec3& step_mm, const Overlap& now) const noexcept;
  [[nodiscard]] bool sunk(const glm::dvec3& place_mm) const noexcept;
  [[nodiscard]] glm::dvec3 permitted(const glm::dvec3& step_mm, double step_s,
                                     double bite_mm) noexcept;

  Snapshot<MouseAim> aim_;
  Resistance resistance_;
  std::atomic<double> stretch_mm_{0.0};
  glm::dvec3 place_mm_{0.0};
  double unbitten_mm2_ = 0.0;  // growth of the overlap that the bites so far still permit
  std::int64_t last_us_ = -1;  // of the last sample; below 0: none since begin_at
};

}  // namespace clay::studio
