#include "claystack/falcon/simulated_falcon.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>

namespace clay::falcon {
namespace {

constexpr double kMPerMm = 1e-3;
constexpr double kMostPauseS = 0.05;

/// A hand that holds an arm, ticked as time passes.
class HeldArm {
 public:
  HeldArm(SimulatedArm arm, HandPath path, const glm::dvec3& centre_m)
      : arm_(std::move(arm)), path_(std::move(path)), centre_m_(centre_m) {}

  glm::dvec3 operator()(const glm::dvec3& force_n, double dt_s) {
    const double period_s = arm_.spec().loop.period_s();
    due_s_ += std::min(dt_s, kMostPauseS);
    // Half a tick of tolerance: frames that come by the clock must not beat against the ticks.
    for (; due_s_ > 0.5 * period_s; due_s_ -= period_s) {
      time_s_ += period_s;
      arm_.advance(force_n, centre_m_ + kMPerMm * path_(time_s_));
    }
    return arm_.reading_m();
  }

 private:
  SimulatedArm arm_;
  HandPath path_;
  glm::dvec3 centre_m_;
  double due_s_ = 0.0, time_s_ = 0.0;
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
  const glm::dvec3& centre = settings.falcon.centre_m;
  auto arm =
      SimulatedArm::build(settings.arm, settings.hand, centre + kMPerMm * settings.path(0.0));
  if (!arm)
    return device_failure(DeviceFault::bad_setting,
                          std::string("simulated: expected ") + arm.error().setting + " from " +
                              std::to_string(arm.error().low) + " to " +
                              std::to_string(arm.error().high) + ", found " +
                              std::to_string(arm.error().found));
  SimulatedFalcon simulated;
  simulated.model = std::make_shared<FalconModel>(settings.model,
                                                  HeldArm(std::move(*arm), settings.path, centre));
  simulated.device = std::make_unique<FalconDevice>(
      std::make_unique<LoopbackTransport>(simulated.model, settings.pace), settings.falcon);
  return simulated;
}

}  // namespace clay::falcon
