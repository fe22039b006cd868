#include "app/studio/readings/subject.hpp"

#include <algorithm>
#include <utility>
#include <vector>

namespace clay::studio {

std::optional<ClayStack> stack_of(const render::PotView& outline, double crown_mm) {
  if (outline.rows.empty()) return std::nullopt;
  const double ring_mm = (outline.height_mm - crown_mm) / static_cast<double>(outline.rows.size());
  std::vector<Ring> rings;
  rings.reserve(outline.rows.size());
  for (const render::Row& row : outline.rows)
    rings.push_back({quanta_from_radius(static_cast<double>(row.outer_mm)),
                     quanta_from_radius(static_cast<double>(row.inner_mm))});
  // A crown is less than a ring.
  const auto crown = static_cast<WideQuanta>(static_cast<double>(rings.back().volume()) *
                                             std::clamp(crown_mm / ring_mm, 0.0, 1.0 - 1e-9));
  auto stack = ClayStack::from_rings(ring_mm, std::move(rings), crown);
  if (!stack) return std::nullopt;
  return std::move(*stack);
}

}  // namespace clay::studio
