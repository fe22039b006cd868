#include "app/import/level_lines.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace clay::importing {
namespace {

/// Levels the points of `line` from `first` on as far as they are nearly level, within `low` to
/// `high` of the drawing; returns where the next run begins.
std::size_t level_run(Line& line, std::size_t first, double within_mm, double low, double high) {
  constexpr double kSlope = 0.2;
  std::vector<glm::dvec2>& points = line.points_mm;
  const std::size_t size = points.size(), most = line.closed ? size : size - first;
  double bottom = points[first].y, top = bottom;
  std::size_t count = 1;
  for (; count < most; ++count) {
    const glm::dvec2 a = points[(first + count - 1) % size], b = points[(first + count) % size];
    const double lower = std::min(bottom, b.y), upper = std::max(top, b.y);
    if (std::abs(b.y - a.y) > kSlope * std::abs(b.x - a.x) || upper - lower > within_mm) break;
    bottom = lower, top = upper;
  }
  const double y = bottom == low ? low : top == high ? high : 0.5 * (bottom + top);
  for (std::size_t i = 0; i < count; ++i) points[(first + i) % size].y = y;
  return first + count;
}

}  // namespace

void straighten(std::vector<Line>& lines) {
  constexpr double kLevelMm = 1e-4;
  std::vector<double*> heights;
  for (Line& line : lines)
    for (glm::dvec2& p : line.points_mm) {
      heights.push_back(&p.y);
      if (std::abs(p.x) <= kLevelMm) p.x = 0.0;
    }
  std::sort(heights.begin(), heights.end(),
            [](const double* a, const double* b) { return *a < *b; });
  const double top = *heights.back();
  for (std::size_t i = 0; i < heights.size();) {
    const double low = *heights[i];
    const double same = top - low <= kLevelMm ? top : low;  // the whole height stays
    for (; i < heights.size() && *heights[i] - low <= kLevelMm; ++i) *heights[i] = same;
  }
}

void level(std::vector<Line>& lines, double within_mm) {
  double low = 1e300, high = -1e300;
  for (const Line& line : lines)
    for (const glm::dvec2& p : line.points_mm) low = std::min(low, p.y), high = std::max(high, p.y);
  for (Line& line : lines)
    for (std::size_t next = 0; next < line.points_mm.size();)
      next = level_run(line, next, within_mm, low, high);
}

}  // namespace clay::importing
