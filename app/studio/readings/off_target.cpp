#include "app/studio/readings/off_target.hpp"

#include "app/import/deviation.hpp"

#include <algorithm>
#include <cstddef>

namespace clay::studio {

namespace {

std::vector<importing::Slab> slabs_of(const render::PotView& pot) {
  std::vector<importing::Slab> slabs;
  slabs.reserve(pot.rows.size());
  const double row_mm = pot.height_mm / static_cast<double>(pot.rows.size());
  for (const render::Row& row : pot.rows) {
    const double from_mm = row_mm * static_cast<double>(slabs.size());
    const double outer = static_cast<double>(row.outer_mm),
                 inner = static_cast<double>(row.inner_mm);
    slabs.push_back({from_mm, from_mm + row_mm, outer, outer, inner, inner});
  }
  return slabs;
}

}  // namespace

std::optional<OffTarget> off_target(const render::PotView& pot, const render::PotView& target) {
  if (pot.rows.empty() || target.rows.empty()) return std::nullopt;
  const auto outline = importing::outline_of(slabs_of(target));
  const auto own = importing::outline_of(slabs_of(pot));
  const importing::Deviation worst = importing::deviation_between(own, outline);
  std::vector<glm::dvec2> points;
  points.reserve(2 * pot.rows.size());
  const double row_mm = pot.height_mm / static_cast<double>(pot.rows.size());
  for (std::size_t i = 0; i < pot.rows.size(); ++i) {
    const double y_mm = row_mm * (static_cast<double>(i) + 0.5);
    const double outer = static_cast<double>(pot.rows[i].outer_mm);
    const double inner = static_cast<double>(pot.rows[i].inner_mm);
    points.emplace_back(outer, y_mm);
    points.emplace_back(inner > 0.0 ? inner : outer, y_mm);  // solid: there is no inner wall
  }
  const std::vector<double> distances = importing::distances_from(outline, points);
  OffTarget off{worst.mm, worst.radius_mm, worst.height_mm, {}};
  off.rows_mm.reserve(pot.rows.size());
  for (std::size_t i = 0; i < pot.rows.size(); ++i)
    off.rows_mm.push_back(static_cast<float>(std::max(distances[2 * i], distances[2 * i + 1])));
  return off;
}

}  // namespace clay::studio
