#include "app/studio/readings/section_rows.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace clay::studio {
namespace {

void add(const Ring& ring, bool first, SectionRow& row) {
  const auto outer = static_cast<float>(ring.outer_mm());
  const auto inner = static_cast<float>(ring.inner_mm());
  if (first) {
    row = {inner, inner, outer, outer};
    return;
  }
  row.inner_least_mm = std::min(row.inner_least_mm, inner);
  row.inner_most_mm = std::max(row.inner_most_mm, inner);
  row.outer_least_mm = std::min(row.outer_least_mm, outer);
  row.outer_most_mm = std::max(row.outer_most_mm, outer);
}

}  // namespace

std::vector<SectionRow> section_rows(const ClayStack& stack, std::size_t rows) {
  std::vector<SectionRow> section(rows);
  const auto rings = stack.rings();
  if (rings.empty()) return {};
  const double row_mm = stack.height_mm() / static_cast<double>(rows);
  const double last = static_cast<double>(rings.size() - 1);
  const auto ring_at = [&](double y_mm) {
    return static_cast<std::size_t>(std::clamp(y_mm / stack.ring_height_mm(), 0.0, last));
  };
  // What only touches a row's edge is not in it.
  const double edge = 1e-9 * stack.ring_height_mm();
  for (std::size_t row = 0; row < rows; ++row) {
    const double low = row_mm * static_cast<double>(row);
    const std::size_t from = ring_at(low + edge), to = ring_at(low + row_mm - edge);
    for (std::size_t ring = from; ring <= to; ++ring) add(rings[ring], ring == from, section[row]);
  }
  return section;
}

double wall_at_height(std::span<const render::RowWall> walls, double height_mm, double y_mm) {
  if (walls.empty() || !(height_mm > 0.0) || y_mm < 0.0 || y_mm > height_mm)
    return std::numeric_limits<double>::infinity();
  const double part = y_mm / height_mm * static_cast<double>(walls.size());
  const auto row = std::min(static_cast<std::size_t>(part), walls.size() - 1);
  return static_cast<double>(std::min(walls[row].outer_mm, walls[row].inner_mm));
}

}  // namespace clay::studio
