#include "app/import/level_faces.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <optional>

namespace clay::importing {
namespace {

// All in units of the noise, a standard deviation.
constexpr double kScatter = 8.0;    // of radii, of a face that rises by less than one in eight
constexpr double kMargin = 2.0;     // around such a face, whose edges the noise rounds
constexpr double kThickest = 20.0;  // both margins, and four deviations to each side of two faces

/// Slabs from `first` to before `end`.
struct Range {
  std::size_t first = 0, end = 0;
};

/// The radii scatter, or change by far more than the height.
bool nearly_level(const ScannedSlab& scanned, double noise_mm) {
  const Slab& slab = scanned.slab;
  const double along = std::max(std::abs(slab.outer_to_mm - slab.outer_from_mm),
                                std::abs(slab.inner_to_mm - slab.inner_from_mm));
  const double least = kScatter * noise_mm;
  return scanned.scatter_mm > least ||
         (along > least && along > kScatter * (slab.to_mm - slab.from_mm));
}

std::vector<Range> level_ranges(const std::vector<ScannedSlab>& slabs, double noise_mm) {
  std::vector<Range> ranges;
  if (!(noise_mm > 0.0)) return ranges;
  for (std::size_t i = 0; i < slabs.size(); ++i) {
    if (!nearly_level(slabs[i], noise_mm)) continue;
    const double from = slabs[i].slab.from_mm - kMargin * noise_mm;
    const double to = slabs[i].slab.to_mm + kMargin * noise_mm;
    Range range{i, i + 1};
    while (range.first > 0 && slabs[range.first - 1].slab.to_mm > from) --range.first;
    while (range.end < slabs.size() && slabs[range.end].slab.from_mm < to) ++range.end;
    if (!ranges.empty() && range.first <= ranges.back().end)
      ranges.back().end = std::max(range.end, ranges.back().end);
    else
      ranges.push_back(range);
  }
  std::erase_if(ranges, [&](const Range& range) {
    return slabs[range.end - 1].slab.to_mm - slabs[range.first].slab.from_mm >
               kThickest * noise_mm ||
           range.end - range.first == slabs.size();
  });
  return ranges;
}

/// The height of a step from the clay below the range to that above it, with the clay of the range.
double level_of(const std::vector<ScannedSlab>& slabs, const Range& range) {
  const double from = slabs[range.first].slab.from_mm, to = slabs[range.end - 1].slab.to_mm;
  const double below = range.first > 0 ? slabs[range.first - 1].clay_mm2 : 0.0;
  const double above = range.end < slabs.size() ? slabs[range.end].clay_mm2 : 0.0;
  double clay = 0.0;
  for (std::size_t i = range.first; i < range.end; ++i)
    clay += slabs[i].clay_mm2 * (slabs[i].slab.to_mm - slabs[i].slab.from_mm);
  if (std::abs(below - above) < 1e-3 * std::max(below, above)) return 0.5 * (from + to);
  return std::clamp((clay + below * from - above * to) / (below - above), from, to);
}

}  // namespace

std::vector<Slab> with_level_faces(const std::vector<ScannedSlab>& slabs, double noise_mm) {
  std::vector<Slab> result;
  std::optional<double> foot_mm;
  std::size_t next = 0;
  const auto keep_to = [&](std::size_t end) {
    for (; next < end; ++next) result.push_back(slabs[next].slab);
  };
  for (const Range& range : level_ranges(slabs, noise_mm)) {
    keep_to(range.first);
    (result.empty() ? foot_mm.emplace() : result.back().to_mm) = level_of(slabs, range);
    next = range.end;
  }
  keep_to(slabs.size());
  if (foot_mm) result.front().from_mm = *foot_mm;
  for (std::size_t i = 1; i < result.size(); ++i) result[i].from_mm = result[i - 1].to_mm;
  return result;
}

}  // namespace clay::importing
