#include "app/render/wall_rows.hpp"

#include "claystack/export/fallen.hpp"
#include "claystack/export/smoothing.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace clay::render {
namespace {

constexpr double kTolerance = 0.02;  // [mm], the default of `claystack export`
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

Result<solid::Profile> wall_profile(const Pot& pot, std::optional<double> min_wall_mm) {
  if (pot.collapse)
    return solid::collapsed_parts(pot, solid::Smoothing::fair, kTolerance)
        .map([](const solid::CollapsedParts& parts) { return parts.together(); });
  solid::SmoothingOptions how;
  how.min_wall_mm = min_wall_mm;
  return solid::smooth_profile_of(pot.stack, how).map([](solid::SmoothedProfile smoothed) {
    return std::move(smoothed.section.profile);
  });
}

std::vector<RowWall> row_walls(const solid::Profile& profile, std::size_t rows, double height_mm) {
  if (rows == 0) return {};
  const double spacing_mm = 0.5 * height_mm / static_cast<double>(rows);
  return row_walls(solid::wall_field(profile, spacing_mm), rows, height_mm);
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
