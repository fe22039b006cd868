#include "app/render/section.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <span>

namespace clay::render {
namespace {

constexpr float kLeanTolerance = 0.09f;  // [rad]: smaller differences are invisible in the shading
constexpr float kWallTolerance = 0.05f;  // [mm]: half a colour of 256
constexpr float kThickest = 1e4f;        // [mm]
constexpr float kLeanSpan = 4.0f;        // minimum span of the inclination, in tolerances

/// Finite, so that interpolation between two rows is defined.
RowWall wall_of(const PotView& pot, std::size_t row) {
  if (row >= pot.wall_mm.size()) return {};
  const RowWall& wall = pot.wall_mm[row];
  return {std::min(wall.outer_mm, kThickest), std::min(wall.inner_mm, kThickest)};
}

bool bore_ends(const Level& a, const Level& b) { return (a.inner > 0.0f) != (b.inner > 0.0f); }

/// Adds the end of one bore, or the start of another, at the height between two rows.
void add_jump(const Level& below, const Level& above, std::vector<Level>& levels) {
  Level low = below, high = above;
  low.y = high.y = 0.5f * (below.y + above.y);
  low.outer = high.outer = 0.5f * (below.outer + above.outer);
  levels.push_back(low);
  levels.push_back(high);
}

/// One level for the middle of each row, and one for each end.
std::vector<Level> all_levels(const PotView& pot, std::size_t first, std::size_t last) {
  const double height = pot.height_mm / static_cast<double>(pot.rows.size());
  const auto level = [&](std::size_t row, double at) {
    const Row& r = pot.rows[row];
    return Level{
        static_cast<float>(height * at), r.outer_mm, r.inner_mm, 0.0f, 0.0f, wall_of(pot, row)};
  };
  std::vector<Level> levels{level(first, static_cast<double>(first))};
  for (std::size_t row = first; row < last; ++row) {
    const Level next = level(row, static_cast<double>(row) + 0.5);
    if (row > first && bore_ends(levels.back(), next)) {
      const Level below = levels.back();
      add_jump(below, next, levels);
    }
    levels.push_back(next);
  }
  levels.push_back(level(last - 1, static_cast<double>(last)));
  return levels;
}

/// By differences over `span_mm` on both sides, but not across a jump.
void measure_leans(std::vector<Level>& levels, float span_mm) {
  const auto jump = [&](std::size_t i) { return !(levels[i].y > levels[i - 1].y); };
  std::size_t low = 0, high = 0;
  for (std::size_t i = 0; i < levels.size(); ++i) {
    if (i > 0 && jump(i)) low = i;
    while (low < i && levels[i].y - levels[low + 1].y >= span_mm) ++low;
    if (low == i && i > 0 && !jump(i)) low = i - 1;
    high = std::max(high, i);
    while (high + 1 < levels.size() && !jump(high + 1) &&
           (high == i || levels[high].y - levels[i].y < span_mm))
      ++high;
    const float rise = levels[high].y - levels[low].y;
    if (!(rise > 0.0f)) continue;
    levels[i].outer_lean = std::atan2(levels[high].outer - levels[low].outer, rise);
    levels[i].inner_lean = std::atan2(levels[high].inner - levels[low].inner, rise);
  }
}

/// The values interpolated between kept levels, each with its tolerance.
using Channels = std::array<float, 6>;

Channels channels_of(const Level& level) {
  return {level.outer,      level.inner,         level.outer_lean,
          level.inner_lean, level.wall.outer_mm, level.wall.inner_mm};
}

/// The slopes of lines from a level that pass all later levels within the tolerances.
class Corridor {
 public:
  Corridor(const Level& from, const Channels& tolerance)
      : y_(from.y), from_(channels_of(from)), tolerance_(tolerance) {
    least_.fill(-std::numeric_limits<float>::infinity());
    most_.fill(std::numeric_limits<float>::infinity());
  }
  /// Whether the line to `level` does; then adds it to the levels to pass.
  bool takes(const Level& level) {
    const Channels to = channels_of(level);
    const float run = level.y - y_;
    bool passes = true;
    for (std::size_t k = 0; k < to.size(); ++k) {
      const float slope = (to[k] - from_[k]) / run, slack = tolerance_[k] / run;
      passes = passes && slope >= least_[k] && slope <= most_[k];
      least_[k] = std::max(least_[k], slope - slack);
      most_[k] = std::min(most_[k], slope + slack);
    }
    return passes;
  }

 private:
  float y_;
  Channels from_, tolerance_, least_{}, most_{};
};

/// Keeps the ascending levels that interpolation cannot replace. O(N).
void simplify(std::span<const Level> levels, float tolerance_mm, std::vector<Level>& kept) {
  const Channels tolerance{tolerance_mm,   tolerance_mm,   kLeanTolerance,
                           kLeanTolerance, kWallTolerance, kWallTolerance};
  kept.push_back(levels.front());
  Corridor corridor(levels.front(), tolerance);
  for (std::size_t i = 1; i < levels.size(); ++i) {
    if (corridor.takes(levels[i])) continue;
    kept.push_back(levels[i - 1]);
    corridor = Corridor(levels[i - 1], tolerance);
    corridor.takes(levels[i]);
  }
  if (levels.size() > 1) kept.push_back(levels.back());
}

}  // namespace

std::vector<Level> levels_of(const PotView& pot, std::size_t first, std::size_t last,
                             float tolerance_mm) {
  last = std::min(last, pot.rows.size());
  if (first >= last) return {};
  std::vector<Level> levels = all_levels(pot, first, last);
  measure_leans(levels, kLeanSpan * tolerance_mm);
  std::vector<Level> kept;
  for (std::size_t begin = 0; begin < levels.size();) {
    std::size_t end = begin + 1;  // a run of ascending levels ends at a jump
    while (end < levels.size() && levels[end].y > levels[end - 1].y) ++end;
    simplify(std::span(levels).subspan(begin, end - begin), tolerance_mm, kept);
    begin = end;
  }
  return kept;
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

}  // namespace clay::render
