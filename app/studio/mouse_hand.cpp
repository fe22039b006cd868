#include "app/studio/mouse_hand.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <glm/geometric.hpp>
#include <iterator>

namespace clay::studio {
namespace {

// Time constant of the hand. It turns sixty positions a second into one smooth motion.
constexpr double kLagS = 0.025;
// A wall that does not give way, such as one at its minimum, stops the hand when the tool is this
// deep in the wall, averaged over the tool's height. A floor stops it when the tool is `kSunkMm`
// below its surface. Clay that yields to a bite reaches neither limit.
constexpr double kDeepestMm = 0.3, kSunkMm = 1.0;
// The rings make the area of a tool that slides along the clay uneven by less than this.
constexpr double kUnevenMm2 = 0.2;
constexpr int kTries = 5;
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
  unbitten_mm2_ = 0.0;
  aim_.write({place_mm, kPressingMmPerS});
}

falcon::DeviceResult<void> MouseDevice::open() { return {}; }

/// Overlap of the tool with the clay at a place of the tool.
MouseDevice::Overlap MouseDevice::overlap(const glm::dvec3& place_mm) const noexcept {
  const ClayStack& clay = *resistance_.clay;
  const Tool& tool = *resistance_.tool;
  const double h = clay.ring_height_mm(), rho = std::hypot(place_mm.x, place_mm.z);
  const auto rings = clay.rings();
  const double y_mm = upright(place_mm.y);
  const double low_mm = y_mm + tool.low(), high_mm = y_mm + tool.high();
  Overlap sum;
  for (auto i = static_cast<std::size_t>(std::max(low_mm / h, 0.0)); i < rings.size(); ++i) {
    // The part of the ring beside the tool, so that flat ends do not enter a ring all at once.
    const double bottom = std::max(static_cast<double>(i) * h, low_mm);
    const double top = std::min(static_cast<double>(i + 1) * h, high_mm);
    if (!(bottom < top)) break;
    const double width = tool.radius(0.5 * (bottom + top) - y_mm);
    const double inner = std::max(rings[i].inner_mm(), rho - width);
    const double depth = std::max(0.0, std::min(rings[i].outer_mm(), rho + width) - inner);
    sum.area_mm2 += (top - bottom) * depth;
    sum.energy_mm3 += 0.5 * (top - bottom) * depth * depth;
  }
  return sum;
}

/// Whether the lower end of the tool is too far below the clay that it stands on.
bool MouseDevice::sunk(const glm::dvec3& place_mm) const noexcept {
  const bool turned = resistance_.turned_mm.has_value();
  const Tool& tool = *resistance_.tool;
  const double h = resistance_.clay->ring_height_mm(), rho = std::hypot(place_mm.x, place_mm.z);
  const auto rings = resistance_.clay->rings();
  const double low_mm = std::max(place_mm.y + (turned ? -tool.high() : tool.low()), 0.0);
  const auto covers = [&](std::ptrdiff_t i) {
    if (i < 0 || i >= std::ssize(rings)) return false;
    const Ring& ring = rings[static_cast<std::size_t>(i)];
    return ring.inner_mm() <= rho && rho < ring.outer_mm();
  };
  for (auto i = static_cast<std::ptrdiff_t>(std::floor(upright(low_mm) / h)); covers(i);
       i += turned ? -1 : 1) {
    const double surface_mm = upright(static_cast<double>(turned ? i : i + 1) * h);
    if (surface_mm - low_mm > kSunkMm) return true;
  }
  return false;
}

/// The part of a step that no wall and no floor blocks.
glm::dvec3 MouseDevice::unstopped(const glm::dvec3& step_mm, const Overlap& now) const noexcept {
  glm::dvec3 way{0.0, step_mm.y, 0.0};
  if (step_mm.y < 0.0 && sunk(place_mm_)) way.y = 0.0;
  double part = 1.0;
  for (int k = 0; k < kTries; ++k, part *= 0.5) {
    const glm::dvec3 out{part * step_mm.x, 0.0, part * step_mm.z};
    if (overlap(place_mm_ + out).energy_mm3 <=
        now.energy_mm3 + kDeepestMm * tool_height_mm() * glm::length(out))
      return way + out;
  }
  return way;
}

/// The part of a step that the strength of the hand permits. Along the clay and away from it the
/// hand is free: if the whole step is too much, the tool slides, out or up as far as it can.
glm::dvec3 MouseDevice::permitted(const glm::dvec3& step_mm, double step_s,
                                  double bite_mm) noexcept {
  if (resistance_.clay == nullptr) return step_mm;
  Overlap now = overlap(place_mm_);
  const glm::dvec3 wanted = unstopped(step_mm, now);
  const double bite_mm2 = bite_mm * resistance_.wheel_rpm / 60.0 * step_s * tool_height_mm();
  unbitten_mm2_ = std::min(unbitten_mm2_ + bite_mm2, bite_mm2 + kUnevenMm2);
  glm::dvec3 moved{0.0};
  const auto bite = [&](const glm::dvec3& way) {
    constexpr double kLeastOfWay = 1.0 / 64.0;
    double part = 1.0;
    for (int k = 0; k < kTries; ++k) {
      const Overlap then = overlap(place_mm_ + moved + part * way);
      const double growth = then.area_mm2 - now.area_mm2;
      if (growth <= unbitten_mm2_) {
        moved += part * way;
        unbitten_mm2_ -= growth;
        now = then;
        return;
      }
      // The growth is only about proportional to the way.
      part *= std::max(0.8 * unbitten_mm2_ / growth, kLeastOfWay);
    }
  };
  bite(wanted);
  if (moved == wanted) return moved;
  const glm::dvec3 rest = wanted - moved;
  bite({rest.x, 0.0, rest.z});
  bite({0.0, rest.y, 0.0});
  return moved;
}

falcon::DeviceSample MouseDevice::read(std::int64_t) noexcept {
  const std::int64_t now_us = clock_.now_us();
  const MouseAim& aim = aim_.newest();
  if (last_us_ >= 0) {
    const double step_s = std::min(kSPerUs * static_cast<double>(now_us - last_us_), kLongestStepS);
    const glm::dvec3 way = aim.place_mm - place_mm_;
    const double far = glm::length(way);
    const double step = std::min({far, aim.speed_mm_s * step_s, far * step_s / kLagS});
    if (far > 0.0 && step > 0.0) place_mm_ += permitted(way * (step / far), step_s, aim.bite_mm);
    stretch_mm_.store(glm::distance(aim.place_mm, place_mm_), std::memory_order_relaxed);
  }
  const bool fresh = now_us > last_us_;
  last_us_ = now_us;
  return {now_us, place_mm_, 0u, falcon::DeviceState::ready, fresh};
}

}  // namespace clay::studio
