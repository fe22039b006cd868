#pragma once
// An arm on the studio's own clock: a hand that goes where the test says, no faster than a hand
// does, and every fault at a word. It remembers what force it was told.

#include "app/servo/clock.hpp"
#include "app/servo/mapping.hpp"
#include "claystack/falcon/device.hpp"

#include <algorithm>
#include <glm/geometric.hpp>
#include <limits>
#include <string>

namespace clay::studio {

/// Outlives the arm. Changed only between frames: without threads nothing ticks then.
struct ArmScript {
  double goal_mm = 80.0;  ///< from the wheel's axis, 15 mm high
  falcon::DeviceState state = falcon::DeviceState::ready;
  bool opens = true;         ///< `open` succeeds
  bool makes_sense = true;   ///< its position is a number
  double told_n = 0.0;       ///< length of the force told last
  double most_n = 0.0;       ///< of all
  std::uint64_t writes = 0;  ///< forces told
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
    glm::dvec3 place_mm = mapping_.to_device({at_mm_, 15.0, 0.0});
    if (!script_.makes_sense) place_mm.x = std::numeric_limits<double>::quiet_NaN();
    const std::int64_t now_us = clock_.now_us();
    const bool fresh = now_us > last_us_;
    last_us_ = now_us;
    return {now_us, place_mm, 0u, script_.state, fresh};
  }
  void write(const glm::dvec3& force_n) noexcept override {
    if (stopped_) return;
    tell(glm::length(force_n));
    ++script_.writes;
  }
  void zero() noexcept override { tell(0.0); }
  void stop() noexcept override {
    tell(0.0);
    stopped_ = true;
  }
  [[nodiscard]] falcon::DeviceError problem() const override {
    return {falcon::DeviceFault::unplugged, "nowhere: unplugged", "plug it in again"};
  }
  [[nodiscard]] falcon::DeviceCounters counters() const noexcept override { return {}; }

 private:
  void tell(double newtons) noexcept {
    script_.told_n = newtons;
    script_.most_n = std::max(script_.most_n, newtons);
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
