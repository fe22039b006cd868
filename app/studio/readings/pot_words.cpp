#include "app/studio/length_text.hpp"
#include "app/studio/readings/pot_check.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace clay::studio {

std::vector<render::RowWall> walls_for(const PotCheck& check, std::size_t rows, double height_mm) {
  if (check.walls.empty() || !(check.height_mm > 0.0)) return {};
  if (check.walls.size() == rows && check.height_mm == height_mm) return check.walls;
  std::vector<render::RowWall> walls(rows);
  const double per_mm = static_cast<double>(check.walls.size()) / check.height_mm;
  for (std::size_t row = 0; row < rows; ++row) {
    const double y_mm = (static_cast<double>(row) + 0.5) * height_mm / static_cast<double>(rows);
    walls[row] =
        check.walls[std::min(static_cast<std::size_t>(y_mm * per_mm), check.walls.size() - 1)];
  }
  return walls;
}

render::WallMap wall_map_of(const PotCheck& check) {
  return {check.limit ? check.limit->min_wall_mm : 0.0, 10.0};
}

std::vector<Stretch> thin_stretches(const PotCheck& check) {
  std::vector<Stretch> stretches;
  if (!check.limit || check.walls.empty()) return stretches;
  const double row_mm = check.height_mm / static_cast<double>(check.walls.size());
  bool open = false;
  for (std::size_t row = 0; row < check.walls.size(); ++row) {
    const render::RowWall& wall = check.walls[row];
    const bool thin =
        static_cast<double>(std::min(wall.outer_mm, wall.inner_mm)) < check.limit->min_wall_mm;
    const double low_mm = row_mm * static_cast<double>(row);
    if (thin && !open) stretches.push_back({low_mm, low_mm});
    if (thin) stretches.back().to_mm = low_mm + row_mm;
    open = thin;
  }
  return stretches;
}

std::string wall_words(const PotCheck& check, LengthUnit unit) {
  if (check.fallen) return "Fallen: its walls are not measured";
  if (!check.proved) return "No walls to measure: the section is not that of one solid";
  std::string words = fmt::format("Thinnest {}, {} up", length_text(check.thinnest_mm, unit),
                                  length_text(check.thinnest_from.y, unit));
  if (check.limit)
    words += fmt::format("; {} asks {}: {}", check.limit->process,
                         length_text(check.limit->min_wall_mm, unit),
                         check.thin() ? "too thin" : "thick enough");
  return words;
}

}  // namespace clay::studio
