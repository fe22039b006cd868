#include "contact.hpp"

#include <algorithm>
#include <cmath>

namespace clay {
namespace {

/// Equations (1), (2). Compared and clamped as doubles: a far pose must not overflow an index.
bool candidates(const Tool& tool, const ClayStack& stack, double hip_y, Contact& contact) noexcept {
  const double count = static_cast<double>(stack.size());
  const double low = (hip_y + tool.low()) / stack.ring_height_mm();
  const double high = (hip_y + tool.high()) / stack.ring_height_mm();
  if (!(high > 0.0 && low < count)) return false;
  contact.top = static_cast<std::size_t>(std::min(count, std::ceil(high))) - 1;
  contact.bottom = static_cast<std::size_t>(std::max(1.0, std::floor(low))) - 1;
  return true;
}

Side side_at(const ClayStack& stack, double hip_y, double axis_distance) noexcept {
  const double last = static_cast<double>(stack.size() - 1);
  const double level = std::clamp(std::floor(hip_y / stack.ring_height_mm()), 0.0, last);
  const Ring& ring = stack.rings()[static_cast<std::size_t>(level)];
  return axis_distance > 0.5 * (ring.outer_mm() + ring.inner_mm()) ? Side::compressive
                                                                   : Side::expansive;
}

template <class Profile>
void touch_rings(const Profile& profile, const Tool& tool, const ClayStack& stack, double hip_y,
                 Contact& contact) noexcept {
  const auto rings = stack.rings();
  const double h = stack.ring_height_mm(), d = contact.axis_distance_mm;
  for (std::size_t i = contact.bottom; i <= contact.top; ++i) {
    const double t = (static_cast<double>(i) + 0.5) * h - hip_y;
    if (t < tool.low() || t > tool.high()) continue;
    const double f = profile.radius(t);
    const double depth = contact.side == Side::compressive ? rings[i].outer_mm() + f - d
                                                           : d + f - rings[i].inner_mm();
    if (depth > 0.0)
      contact.rings.push_back({static_cast<std::uint32_t>(i), depth, profile.slope(t)});
  }
}

void touch_rings(const Tool& tool, const ClayStack& stack, double hip_y,
                 Contact& contact) noexcept {
  std::visit([&](const auto& profile) { touch_rings(profile, tool, stack, hip_y, contact); },
             tool.profile());
}

/// The tool's centre at `at` along the HIP's radius; below 0 it is beyond the axis.
void stand(double at, double radial_x, double radial_z, Contact& contact) noexcept {
  const double sense = at > 0.0 ? 1.0 : at < 0.0 ? -1.0 : 0.0;
  contact.axis_distance_mm = std::abs(at);
  contact.radial_x = sense * radial_x;
  contact.radial_z = sense * radial_z;
}

}  // namespace

std::size_t most_contacts(const Tool& tool, double ring_height_mm, std::size_t max_rings) {
  const double rings = (tool.high() - tool.low()) / ring_height_mm + 3.0;
  return static_cast<std::size_t>(std::min(rings, static_cast<double>(max_rings)));
}

void find_contact(const Tool& tool, const ClayStack& stack, const glm::dvec3& hip_mm,
                  Contact& contact) noexcept {
  contact.rings.clear();
  if (!candidates(tool, stack, hip_mm.y, contact)) return;
  const double d = std::sqrt(hip_mm.x * hip_mm.x + hip_mm.z * hip_mm.z);
  contact.axis_distance_mm = d;
  contact.radial_x = d > 0.0 ? hip_mm.x / d : 0.0;
  contact.radial_z = d > 0.0 ? hip_mm.z / d : 0.0;
  contact.side = side_at(stack, hip_mm.y, d);
  touch_rings(tool, stack, hip_mm.y, contact);
}

void find_pinch(const Tool& tool, const ClayStack& stack, const glm::dvec3& hip_mm, double gap_mm,
                Contact& outer, Contact& inner) noexcept {
  outer.rings.clear();
  inner.rings.clear();
  if (!candidates(tool, stack, hip_mm.y, outer)) return;
  inner.bottom = outer.bottom;
  inner.top = outer.top;
  const double d = std::sqrt(hip_mm.x * hip_mm.x + hip_mm.z * hip_mm.z);
  const double radial_x = d > 0.0 ? hip_mm.x / d : 0.0, radial_z = d > 0.0 ? hip_mm.z / d : 0.0;
  const double reach = 0.5 * gap_mm + tool.widest();
  stand(d + reach, radial_x, radial_z, outer);
  stand(d - reach, radial_x, radial_z, inner);
  outer.side = Side::compressive;
  inner.side = Side::expansive;
  touch_rings(tool, stack, hip_mm.y, outer);
  touch_rings(tool, stack, hip_mm.y, inner);
}

}  // namespace clay
