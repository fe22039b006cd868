#include "app/render/wall_rows.hpp"

#include "claystack/engine/clay.hpp"
#include "claystack/export/fallen.hpp"
#include "claystack/export/job.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace clay::render {
namespace {

constexpr double kToleranceMm = 0.02;  // [mm], the default of `claystack export`
constexpr float kUnknown = std::numeric_limits<float>::infinity();

/// Rows between samples take the thickness of the nearest row with one.
void fill_gaps(std::vector<RowWall>& walls, float RowWall::*face, std::vector<bool>& known) {
  const std::size_t count = walls.size();
  std::vector<std::size_t> below(count, count);
  for (std::size_t i = 0; i < count; ++i) below[i] = known[i] ? i : i > 0 ? below[i - 1] : count;
  std::size_t above = count;
  for (std::size_t i = count; i-- > 0;) {
    if (known[i]) above = i;
    if (known[i]) continue;
    const std::size_t low = below[i];
    if (low == count && above == count) continue;
    const bool down = above == count || (low != count && i - low <= above - i);
    walls[i].*face = walls[down ? low : above].*face;
  }
}

}  // namespace

Result<MappedWalls> map_walls(const Pot& pot, const solid::WallDemand& demand, std::size_t rows) {
  const double height_mm = pot.stack.height_mm();
  const double spacing_mm = 0.5 * height_mm / static_cast<double>(std::max<std::size_t>(rows, 1));
  if (pot.collapse)
    return solid::collapsed_parts(pot, solid::Smoothing::fair, kToleranceMm)
        .map([&](const solid::CollapsedParts& parts) {
          const solid::Profile profile = parts.together();
          return MappedWalls{row_walls(solid::wall_field(profile, spacing_mm), rows, height_mm),
                             solid::min_wall_mm(profile),
                             demand.for_size(solid::size_sum_mm(solid::round_size_mm(
                                 2.0 * largest_radius_mm(pot.stack), height_mm)))};
        });
  solid::ExportOptions options;
  options.walls = demand;
  options.allow_pieces = true;
  options.wall_spacing_mm = spacing_mm;
  return solid::run_export(pot, {}, options).map([&](const solid::ExportReport& report) {
    return MappedWalls{row_walls(report.walls.field, rows, height_mm), report.walls.min_wall_mm,
                       report.walls.limit};
  });
}

Result<MappedWalls> show_walls(const Pot& pot, const solid::WallDemand& demand, Picture& picture) {
  return map_walls(pot, demand, picture.pot.rows.size()).map([&](MappedWalls walls) {
    picture.pot.wall_mm = walls.rows;
    picture.wall_map = WallMap{0.0, kFileMapTopMm};
    if (walls.limit)
      picture.wall_map = WallMap{walls.limit->least_mm(), kFileMapTopMm, walls.limit->min_wall_mm};
    return walls;
  });
}

std::vector<RowWall> row_walls(std::span<const solid::WallSample> field, std::size_t rows,
                               double height_mm) {
  std::vector<RowWall> walls(rows, {kUnknown, kUnknown});
  if (rows == 0) return walls;
  const double row_height = height_mm / static_cast<double>(rows);
  std::vector<bool> outside(rows, false), inside(rows, false);
  for (const solid::WallSample& s : field) {
    // Feet are visible only from below; their thickness is shown on the floor.
    if (s.face == solid::WallFace::rim || s.face == solid::WallFace::foot) continue;
    // A floor belongs to the row below it.
    const double y = s.at.y - (s.face == solid::WallFace::floor ? 1e-3 * row_height : 0.0);
    const auto row = static_cast<std::size_t>(
        std::clamp(std::floor(y / row_height), 0.0, static_cast<double>(rows - 1)));
    const bool out = s.face == solid::WallFace::outer;
    float& least = out ? walls[row].outer_mm : walls[row].inner_mm;
    least = std::min(least, static_cast<float>(s.thickness_mm));
    (out ? outside : inside)[row] = true;
  }
  fill_gaps(walls, &RowWall::outer_mm, outside);
  fill_gaps(walls, &RowWall::inner_mm, inside);
  return walls;
}

}  // namespace clay::render
