#include "draw/section.hpp"

#include <algorithm>

namespace clay::draw {
namespace {

RowWall wall_of(const PotView& pot, std::size_t row) {
  return row < pot.wall_mm.size() ? pot.wall_mm[row] : RowWall{};
}

bool bore_ends(const Row& a, const Row& b) { return (a.inner_mm > 0.0f) != (b.inner_mm > 0.0f); }

/// The end of one bore, or the beginning of another, at the height between two rows.
void add_jump(const PotView& pot, std::size_t row, float y, std::vector<Level>& levels) {
  const Row& below = pot.rows[row];
  const Row& above = pot.rows[row + 1];
  const float outer = 0.5f * (below.outer_mm + above.outer_mm);
  levels.push_back({y, outer, below.inner_mm, wall_of(pot, row)});
  levels.push_back({y, outer, above.inner_mm, wall_of(pot, row + 1)});
}

}  // namespace

std::vector<Level> levels_of(const PotView& pot, std::size_t first, std::size_t last) {
  std::vector<Level> levels;
  last = std::min(last, pot.rows.size());
  if (first >= last) return levels;
  const double height = pot.height_mm / static_cast<double>(pot.rows.size());
  const auto y_of = [&](double rows) { return static_cast<float>(height * rows); };
  const auto add = [&](std::size_t row, double at) {
    const Row& r = pot.rows[row];
    levels.push_back({y_of(at), r.outer_mm, r.inner_mm, wall_of(pot, row)});
  };
  const std::size_t stride = (last - first + kDrawnRows - 1) / kDrawnRows;
  add(first, static_cast<double>(first));
  for (std::size_t row = first; row < last; ++row) {
    const bool jumps = row + 1 < last && bore_ends(pot.rows[row], pot.rows[row + 1]);
    const bool jumped = row > first && bore_ends(pot.rows[row - 1], pot.rows[row]);
    if (jumps || jumped || row + 1 == last || (row - first) % stride == 0)
      add(row, static_cast<double>(row) + 0.5);
    if (jumps) add_jump(pot, row, y_of(static_cast<double>(row + 1)), levels);
  }
  add(last - 1, static_cast<double>(last));
  return levels;
}

std::vector<Slice> slices_of(const std::vector<Level>& levels) {
  std::vector<Slice> slices;
  for (std::size_t i = 1; i < levels.size(); ++i) {
    const Level& low = levels[i - 1];
    const Level& high = levels[i];
    if (!(high.y > low.y)) continue;
    slices.push_back({{low.inner, low.outer},
                      {high.inner, high.outer},
                      {low.y, high.y},
                      {std::min(low.wall.outer_mm, low.wall.inner_mm),
                       std::min(high.wall.outer_mm, high.wall.inner_mm)}});
  }
  return slices;
}

}  // namespace clay::draw
