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

}  // namespace clay
