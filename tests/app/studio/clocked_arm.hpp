#pragma once
// An arm on the studio's clock. Its hand moves to the goal of the test at 0.4 mm per sample, its
// faults are settings, and it records the commanded force.

#include "app/servo/clock.hpp"
#include "app/servo/mapping.hpp"
#include "claystack/falcon/device.hpp"

#include <algorithm>
#include <glm/geometric.hpp>
#include <limits>
#include <string>

namespace clay::studio {

/// Outlives the arm. Tests change it only between frames; without threads nothing ticks then.
struct ArmScript {
  double goal_mm = 80.0;  ///< from the wheel's axis, 15 mm high
  falcon::DeviceState state = falcon::DeviceState::ready;
  bool opens = true;           ///< `open` succeeds
  bool position_valid = true;  ///< otherwise its position is NaN
  double last_force_n = 0.0;   ///< magnitude of the last commanded force
  double max_force_n = 0.0;    ///< largest commanded force
  std::uint64_t writes = 0;    ///< commanded forces
};

class ClockedArm final : public falcon::HapticDevice {
 public:
  ClockedArm(servo::Clock& clock, ArmScript& script)
      : clock_(clock), script_(script), mapping_(servo::Mapping::build({}).value()) {
    info_ = {"Clocked arm", "nowhere", true, 8.0, glm::dvec3(48.0), 1000.0};
  }
  [[nodiscard]] const falcon::DeviceInfo& info() const noexcept override { return info_; }
  falcon::DeviceResult<void> open() override {
    if (!script_.opens) return tl::make_unexpected(problem());
    stopped_ = false;
    return {};
  }
  falcon::DeviceSample read(std::int64_t) noexcept override {
    constexpr double kStepMm = 0.4;
    at_mm_ += std::clamp(script_.goal_mm - at_mm_, -kStepMm, kStepMm);
    glm::dvec3 position_mm = mapping_.to_device({at_mm_, 15.0, 0.0});
    if (!script_.position_valid) position_mm.x = std::numeric_limits<double>::quiet_NaN();
    const std::int64_t now_us = clock_.now_us();
    const bool fresh = now_us > last_us_;
    last_us_ = now_us;
    return {now_us, position_mm, 0u, script_.state, fresh};
  }
  void write(const glm::dvec3& force_n) noexcept override {
    if (stopped_) return;
    record(glm::length(force_n));
    ++script_.writes;
  }
  void zero() noexcept override { record(0.0); }
  void stop() noexcept override {
    record(0.0);
    stopped_ = true;
  }
  [[nodiscard]] falcon::DeviceError problem() const override {
    return {falcon::DeviceFault::unplugged, "nowhere: unplugged", "plug it in again"};
  }
  [[nodiscard]] falcon::DeviceCounters counters() const noexcept override { return {}; }

 private:
  void record(double newtons) noexcept {
    script_.last_force_n = newtons;
    script_.max_force_n = std::max(script_.max_force_n, newtons);
  }

  servo::Clock& clock_;
  ArmScript& script_;
  servo::Mapping mapping_;
  falcon::DeviceInfo info_;
  double at_mm_ = 80.0;
  std::int64_t last_us_ = -1;
  bool stopped_ = false;
};

}  // namespace clay::studio
