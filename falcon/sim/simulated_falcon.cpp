#include "claystack/falcon/sim.hpp"
#include "falcon/device/falcon_device.hpp"
#include "falcon/device/setting_ranges.hpp"
#include "falcon/sim/falcon_model.hpp"
#include "falcon/sim/loopback_transport.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>

namespace clay::falcon::inline sim {
namespace {

constexpr double kMostPauseS = 0.05;

/// An arm held by a hand, ticked as time passes.
class HeldArm {
 public:
  HeldArm(SimulatedArm arm, const SimulatedSettings& settings)
      : arm_(std::move(arm)),
        path_(settings.path),
        fingers_(settings.fingers),
        centre_mm_(settings.falcon.centre_mm) {}

  glm::dvec3 move(const glm::dvec3& force_n, double dt_s) {
    const double period_s = arm_.settings().loop.period_s();
    due_s_ += std::min(dt_s, kMostPauseS);
    // Half a tick of tolerance, so that periodic frames do not beat against the ticks.
    for (; due_s_ > 0.5 * period_s; due_s_ -= period_s) {
      time_s_ += period_s;
      arm_.advance(force_n, centre_mm_ + path_(time_s_));
    }
    return arm_.reading_mm();
  }

  [[nodiscard]] Fingers fingers() const { return fingers_ ? fingers_(time_s_) : Fingers{}; }

 private:
  SimulatedArm arm_;
  HandPath path_;
  HandFingers fingers_;
  glm::dvec3 centre_mm_;
  double due_s_ = 0.0, time_s_ = 0.0;
};

/// The real driver, with the simulated grip.
class GrippedFalcon final : public HapticDevice {
 public:
  GrippedFalcon(std::unique_ptr<Transport> line, const FalconSettings& settings,
                std::shared_ptr<const HeldArm> held)
      : falcon_(std::move(line), settings), info_(falcon_.info()), held_(std::move(held)) {
    info_.name = "Simulated Falcon";
  }

  [[nodiscard]] const DeviceInfo& info() const noexcept override { return info_; }
  DeviceResult<void> open() override {
    auto opened = falcon_.open();
    info_.answer_us = falcon_.info().answer_us;
    return opened;
  }
  DeviceSample read(std::int64_t wait_us) noexcept override {
    DeviceSample sample = falcon_.read(wait_us);
    sample.grip_mm = held_->fingers().grip_mm;
    return sample;
  }
  void write(const glm::dvec3& force_n) noexcept override { falcon_.write(force_n); }
  void zero() noexcept override { falcon_.zero(); }
  void stop() noexcept override { falcon_.stop(); }
  [[nodiscard]] DeviceError problem() const override { return falcon_.problem(); }
  [[nodiscard]] DeviceCounters counters() const noexcept override { return falcon_.counters(); }

 private:
  FalconDevice falcon_;
  DeviceInfo info_;
  std::shared_ptr<const HeldArm> held_;
};

}  // namespace

glm::dvec3 idle_circle_mm(double time_s) {
  const double turn = 2.0 * std::numbers::pi * time_s / 4.0;
  return {20.0 * std::cos(turn), 20.0 * std::sin(turn), 0.0};
}

SimulatedSettings simulated_and_loaded() {
  SimulatedSettings settings;
  settings.model.loaded = true;
  return settings;
}

DeviceResult<SimulatedFalcon> make_simulated_falcon(const SimulatedSettings& settings) {
  if (settings.model.homing_frames < 1)
    return device_failure(DeviceFault::bad_setting,
                          "simulated: homing_frames: expected at least 1, found " +
                              std::to_string(settings.model.homing_frames));
  if (!settings.path)
    return device_failure(DeviceFault::bad_setting, "simulated: expected a path, found none");
  const glm::dvec3& centre = settings.falcon.centre_mm;
  auto arm = SimulatedArm::build(settings.arm, settings.hand, centre + settings.path(0.0));
  if (!arm) return bad_setting("simulated", arm.error());
  const auto held = std::make_shared<HeldArm>(std::move(*arm), settings);
  const auto model = std::make_shared<FalconModel>(
      settings.model,
      [held](const glm::dvec3& force_n, double dt_s) { return held->move(force_n, dt_s); });
  if (settings.fingers) model->hold([held]() noexcept { return held->fingers().buttons; });
  auto line = std::make_unique<LoopbackTransport>(model, settings.clock);
  SimulatedFalcon simulated;
  simulated.line = line.get();
  simulated.device = std::make_unique<GrippedFalcon>(std::move(line), settings.falcon, held);
  return simulated;
}

}  // namespace clay::falcon::inline sim
