#include "app/studio/mouse_hand.hpp"

#include <algorithm>
#include <glm/geometric.hpp>

namespace clay::studio {
namespace {

// Time constant of the hand. It turns sixty positions a second into one smooth motion.
constexpr double kLagS = 0.025;
constexpr double kLongestStepS = 0.01;
constexpr double kSPerUs = 1e-6;

}  // namespace

servo::LiveSettings MouseDevice::servo_settings() noexcept {
  servo::LiveSettings settings;
  settings.mapping.scale = 1.0;
  settings.mapping.reach_mm = 0.0;
  settings.mapping.height_mm = 0.0;
  settings.buttons = {0, 0, 0, 0};
  return settings;
}

void MouseDevice::begin_at(const glm::dvec3& place_mm) noexcept {
  place_mm_ = place_mm;
  last_us_ = -1;
  aim_.write({place_mm, kPressingMmPerS});
}

falcon::DeviceResult<void> MouseDevice::open() { return {}; }

falcon::DeviceSample MouseDevice::read(std::int64_t) noexcept {
  const std::int64_t now_us = clock_.now_us();
  const MouseAim& aim = aim_.newest();
  if (last_us_ >= 0) {
    const double step_s = std::min(kSPerUs * static_cast<double>(now_us - last_us_), kLongestStepS);
    const glm::dvec3 way = aim.place_mm - place_mm_;
    const double far = glm::length(way);
    const double step = std::min({far, aim.speed_mm_s * step_s, far * step_s / kLagS});
    if (far > 0.0 && step > 0.0) place_mm_ += way * (step / far);
  }
  const bool fresh = now_us > last_us_;
  last_us_ = now_us;
  return {now_us, place_mm_, 0u, falcon::DeviceState::ready, fresh};
}

}  // namespace clay::studio
