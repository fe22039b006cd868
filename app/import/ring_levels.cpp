#include "app/import/ring_levels.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace clay::importing {
namespace {

constexpr double kStepMm = 1e-6;   // narrower treads are rounding
constexpr double kExactMm = 1e-7;  // bounds nearer than this meet the level
constexpr double kMostTried = 2e7;

}  // namespace

std::vector<double> drawn_levels(const HalfSection& section) {
  const std::vector<Slab>& slabs = section.slabs;
  std::vector<double> levels{0.0};
  for (std::size_t i = 0; i + 1 < slabs.size(); ++i) {
    const Slab &below = slabs[i], &above = slabs[i + 1];
    if (std::abs(below.outer_to_mm - above.outer_from_mm) > kStepMm ||
        std::abs(below.inner_to_mm - above.inner_from_mm) > kStepMm)
      levels.push_back(below.to_mm);
  }
  levels.push_back(section.height_mm);
  return levels;
}

std::size_t fitting_ring_count(const std::vector<double>& levels, std::size_t fewest,
                               std::size_t most) {
  if (levels.size() <= 2) return fewest;
  const auto tried = static_cast<std::size_t>(std::min(
      static_cast<double>(fewest) + 1.0, 1.0 + kMostTried / static_cast<double>(levels.size())));
  const std::size_t candidates = std::min(tried, most - fewest + 1);
  std::size_t best = fewest;
  double best_mm = 1e300;
  for (std::size_t count = fewest; count < fewest + candidates && best_mm > kExactMm; ++count) {
    const double ring_mm = levels.back() / static_cast<double>(count);
    double worst = 0.0;
    for (const double level : levels)
      worst = std::max(worst, std::abs(std::remainder(level, ring_mm)));
    if (worst < best_mm) {
      best_mm = worst;
      best = count;
    }
  }
  return best;
}

std::vector<Slab> on_ring_bounds(const HalfSection& section, const std::vector<double>& levels,
                                 std::size_t count) {
  const double ring_mm = section.height_mm / static_cast<double>(count);
  std::vector<std::pair<double, double>> moves{{0.0, 0.0}};  // of levels, from and to
  double bound = 0.0;
  for (std::size_t i = 1; i < levels.size(); ++i) {
    const bool rim = i + 1 == levels.size();
    const double ring = rim ? static_cast<double>(count) : std::round(levels[i] / ring_mm);
    if (ring <= bound || (!rim && ring >= static_cast<double>(count))) continue;
    bound = ring;
    moves.emplace_back(levels[i], rim ? section.height_mm : ring * ring_mm);
  }
  std::size_t next = 1;
  const auto moved = [&](double y) {
    while (next + 1 < moves.size() && y > moves[next].first) ++next;
    const auto& [from, to] = moves[next - 1];
    const auto& [end, target] = moves[next];
    if (y >= end) return target;
    return to + (target - to) * ((y - from) / (end - from));
  };
  std::vector<Slab> slabs = section.slabs;
  for (Slab& slab : slabs) {
    slab.from_mm = moved(slab.from_mm);
    slab.to_mm = moved(slab.to_mm);
  }
  for (std::size_t i = 1; i < slabs.size(); ++i) slabs[i].from_mm = slabs[i - 1].to_mm;
  return slabs;
}

}  // namespace clay::importing
