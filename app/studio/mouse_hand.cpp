#include "app/studio/mouse_hand.hpp"

#include <algorithm>
#include <cmath>
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
  resistance_ = {};
  stretch_mm_.store(0.0, std::memory_order_relaxed);
  last_us_ = -1;
  aim_.write({place_mm, kPressingMmPerS});
}

falcon::DeviceResult<void> MouseDevice::open() { return {}; }

/// The area of the section in which the tool would overlap the clay.
double MouseDevice::overlap_mm2(const glm::dvec3& place_mm) const noexcept {
  const ClayStack& clay = *resistance_.clay;
  const Tool& tool = *resistance_.tool;
  const double h = clay.ring_height_mm(), rho = std::hypot(place_mm.x, place_mm.z);
  const auto rings = clay.rings();
  const auto first = static_cast<std::size_t>(std::clamp(std::floor((place_mm.y + tool.low()) / h),
                                                         0.0, static_cast<double>(rings.size())));
  double area_mm2 = 0.0;
  for (std::size_t i = first; i < rings.size(); ++i) {
    const double t = (static_cast<double>(i) + 0.5) * h - place_mm.y;
    if (t > tool.high()) break;
    if (t < tool.low()) continue;
    const double width = tool.radius(t);
    const double inner = std::max(rings[i].inner_mm(), rho - width);
    area_mm2 += h * std::max(0.0, std::min(rings[i].outer_mm(), rho + width) - inner);
  }
  return area_mm2;
}

/// The part of a step that the strength of the hand permits. Along the clay and away from it the
/// hand is free.
double MouseDevice::yielding_part(const glm::dvec3& step_mm, double step_s,
                                  double bite_mm) const noexcept {
  if (resistance_.clay == nullptr) return 1.0;
  const Tool& tool = *resistance_.tool;
  const double bite_mm_s = bite_mm * resistance_.wheel_rpm / 60.0;
  const double permitted = bite_mm_s * step_s * (tool.high() - tool.low());
  const double now = overlap_mm2(place_mm_);
  double part = 1.0;
  constexpr int kHalvings = 5;
  for (int k = 0; k < kHalvings; ++k, part *= 0.5)
    if (overlap_mm2(place_mm_ + part * step_mm) - now <= permitted) return part;
  return part;
}

falcon::DeviceSample MouseDevice::read(std::int64_t) noexcept {
  const std::int64_t now_us = clock_.now_us();
  const MouseAim& aim = aim_.newest();
  if (last_us_ >= 0) {
    const double step_s = std::min(kSPerUs * static_cast<double>(now_us - last_us_), kLongestStepS);
    const glm::dvec3 way = aim.place_mm - place_mm_;
    const double far = glm::length(way);
    const double step = std::min({far, aim.speed_mm_s * step_s, far * step_s / kLagS});
    if (far > 0.0 && step > 0.0) {
      const glm::dvec3 wanted = way * (step / far);
      place_mm_ += yielding_part(wanted, step_s, aim.bite_mm) * wanted;
    }
    stretch_mm_.store(glm::distance(aim.place_mm, place_mm_), std::memory_order_relaxed);
  }
  const bool fresh = now_us > last_us_;
  last_us_ = now_us;
  return {now_us, place_mm_, 0u, falcon::DeviceState::ready, fresh};
}

}  // namespace clay::studio
