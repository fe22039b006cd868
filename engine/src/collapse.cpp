#include "collapse.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace clay {
namespace {

/// First angle at which the circle of radius `radius` at height `w` above the pivot touches the
/// wheel. Its lowest point is at pivot_y + w cos a - (pivot_x + radius) sin a.
double touch_angle(double pivot_x, double pivot_y, double radius, double w) noexcept {
  const double arm = pivot_x + radius;
  const double reach = std::hypot(arm, w);
  if (pivot_y >= reach) return std::numbers::pi;
  return std::atan2(w, arm) + std::asin(pivot_y / reach);
}

/// Angle at which the centre of mass, now at (-pivot_x, w), hangs straight below the pivot.
double hanging_angle(double pivot_x, double w) noexcept { return std::atan2(pivot_x, -w); }

double top_of(const ClayStack& stack, std::size_t ring) noexcept {
  return stack.ring_height_mm() * static_cast<double>(ring + 1);
}

double centre_of_mass(const ClayStack& stack, std::size_t first) noexcept {
  double mass = 0.0, moment = 0.0;
  const auto add = [&](double volume, double middle) {
    mass += volume;
    moment += volume * middle;
  };
  for (std::size_t i = first; i < stack.size(); ++i)
    add(static_cast<double>(stack.rings()[i].volume()),
        top_of(stack, i) - 0.5 * stack.ring_height_mm());
  add(static_cast<double>(stack.crown()), stack.height_mm() - 0.5 * stack.crown_height_mm());
  return moment / mass;
}

}  // namespace

Collapse settle(const ClayStack& stack, const Failure& failure, const glm::dvec3& hip_mm) noexcept {
  const double x = std::hypot(hip_mm.x, hip_mm.z);
  // On the axis every side is as good as another.
  const double cos_psi = x > 0.0 ? hip_mm.x / x : 1.0, sin_psi = x > 0.0 ? hip_mm.z / x : 0.0;
  const std::size_t first = failure.ring + 1;

  double angle = std::numbers::pi;
  if (first < stack.size() || stack.crown() > 0) {
    angle = hanging_angle(x, centre_of_mass(stack, first) - hip_mm.y);
    for (std::size_t i = first; i < stack.size(); ++i) {
      const double radius = stack.rings()[i].outer_mm();
      const double top = i + 1 == stack.size() ? stack.height_mm() : top_of(stack, i);
      for (const double y : {top_of(stack, i) - stack.ring_height_mm(), top})
        angle = std::min(angle, touch_angle(x, hip_mm.y, radius, y - hip_mm.y));
    }
  }
  return {failure.ring, hip_mm, {-sin_psi, 0.0, cos_psi}, std::max(angle, 0.0), failure.stress_kpa};
}

}  // namespace clay
