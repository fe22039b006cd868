#include "studio/readings/subject.hpp"

#include <utility>
#include <vector>

namespace clay::studio {

std::optional<ClayStack> stack_of(const draw::PotView& outline) {
  if (outline.rows.empty()) return std::nullopt;
  std::vector<Ring> rings;
  rings.reserve(outline.rows.size());
  for (const draw::Row& row : outline.rows)
    rings.push_back({quanta_from_radius(static_cast<double>(row.outer_mm)),
                     quanta_from_radius(static_cast<double>(row.inner_mm))});
  auto stack = ClayStack::from_rings(outline.height_mm / static_cast<double>(outline.rows.size()),
                                     std::move(rings), 0);
  if (!stack) return std::nullopt;
  return std::move(*stack);
}

}  // namespace clay::studio
