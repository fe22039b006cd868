#include "engine/tick/beside_tool.hpp"

#include "engine/clay/packs.hpp"

#include <algorithm>
#include <variant>

namespace clay {

void radii_beside(const Tool& tool, double h, double hip_y, std::size_t first, std::size_t count,
                  double* radii) noexcept {
  const double start = static_cast<double>(first) + 0.5, low = tool.low(), high = tool.high();
  std::visit(
      [=](const auto& profile) {
        // Whole fours: a remainder would be done row by row.
        in_lanes([=, &profile, rows = (count + 3) / 4 * 4]() CLAYSTACK_INLINE {
          for (std::size_t k = 0; k < rows; ++k) {
            const double t = (start + kLevels[k]) * h - hip_y;
            const double f = profile.radius(lesser(greater(t, low), high));
            radii[k] = t >= low && t <= high ? f : -1.0;
          }
        });
      },
      tool.profile());
  std::fill(radii + count, radii + in_packs_of(count), -1.0);
}

bool rise_clear(const Tool& tool, const ClayStack& stack, double hip_y, const Contact& contact,
                const Ring& fresh, std::size_t at) noexcept {
  const double h = stack.ring_height_mm();
  double t = (static_cast<double>(at) + 0.5) * h - hip_y;
  const auto enters = [&](const Ring& ring) {
    return t >= tool.low() && depth_of(ring, tool.radius(t), contact) > 0.0;
  };
  if (t <= tool.high() && enters(fresh)) return false;
  for (const Ring& ring : stack.rings().subspan(at)) {
    t += h;
    if (t > tool.high()) break;
    if (enters(ring)) return false;
  }
  return true;
}

}  // namespace clay
