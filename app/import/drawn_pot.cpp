#include "app/import/drawn_pot.hpp"

#include "app/import/ring_levels.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace clay::importing {
namespace {

/// Calls `use(ring, part)` for each part of a slab that lies within one ring, bottom to top.
template <class Use>
void for_each_part(const std::vector<Slab>& slabs, double ring_mm, std::size_t count, Use use) {
  std::size_t ring = 0;
  for (const Slab& slab : slabs) {
    double from = slab.from_mm;
    while (from < slab.to_mm) {
      const double top = ring + 1 < count ? static_cast<double>(ring + 1) * ring_mm : slab.to_mm;
      const double end = std::min(slab.to_mm, top);
      if (end > from) use(ring, part_of(slab, from, end));
      from = std::max(from, end);
      if (ring + 1 < count && from >= top) ++ring;
    }
  }
}

/// The integral of a squared radius that is linear in height.
double squares(double height, double a, double b) { return height * (a * a + a * b + b * b) / 3.0; }

struct Squares {
  double outer = 0.0, inner = 0.0;
};

/// Squares of the radii over the height of each ring.
using RingSums = std::vector<Squares>;

RingSums sums_of(const std::vector<Slab>& slabs, double ring_mm, std::size_t count) {
  RingSums sums(count);
  for_each_part(slabs, ring_mm, count, [&](std::size_t ring, const Slab& part) {
    const double height = part.to_mm - part.from_mm;
    sums[ring].outer += squares(height, part.outer_from_mm, part.outer_to_mm);
    sums[ring].inner += squares(height, part.inner_from_mm, part.inner_to_mm);
  });
  return sums;
}

Result<std::vector<Ring>> rings_of(const RingSums& sums, double ring_mm, const std::string& name) {
  std::vector<Ring> rings;
  for (const Squares& sum : sums) {
    const double outer2 = sum.outer / ring_mm, inner2 = sum.inner / ring_mm;
    if (!(outer2 <= kMaxRadiusMm * kMaxRadiusMm))
      return failure(ErrorKind::bad_input,
                     fmt::format("{}: {:.3f} mm above the foot: expected a radius up to {:g} mm, "
                                 "found {:g}",
                                 name, static_cast<double>(rings.size()) * ring_mm, kMaxRadiusMm,
                                 std::sqrt(outer2)));
    rings.push_back({quanta_from_mm2(outer2), quanta_from_mm2(inner2)});
  }
  return rings;
}

std::vector<Slab> slabs_of_rings(std::span<const Ring> rings, double ring_mm) {
  std::vector<Slab> slabs;
  slabs.reserve(rings.size());
  for (std::size_t i = 0; i < rings.size(); ++i) {
    const double outer = rings[i].outer_mm(), inner = rings[i].inner_mm();
    slabs.push_back({static_cast<double>(i) * ring_mm, static_cast<double>(i + 1) * ring_mm, outer,
                     outer, inner, inner});
  }
  return slabs;
}

struct DrawnRings {
  std::vector<Ring> rings;
  double ring_mm = 0.0;
  Deviation deviation;
};

/// The most rings that a stack of this height can have.
std::size_t most_rings(double height_mm) {
  double most = std::floor(height_mm / kMinRingHeightMm);
  if (height_mm / most < kMinRingHeightMm) most -= 1.0;  // rounding
  return static_cast<std::size_t>(std::clamp(most, 1.0, static_cast<double>(kMaxRings)));
}

/// Rings of at most this height, as far as a stack can have such low ones.
Result<DrawnRings> drawn_rings(const HalfSection& section, const std::vector<double>& levels,
                               double highest_mm, const std::string& name) {
  // A height that is a multiple up to rounding needs no ring more.
  const double wanted = std::max(1.0, std::ceil(section.height_mm / highest_mm - 1e-9));
  if (!(wanted <= static_cast<double>(kMaxRings)))
    return failure(ErrorKind::bad_input,
                   fmt::format("{}: expected at most {} rings, found {:g} mm in rings of {:g} mm",
                               name, kMaxRings, section.height_mm, highest_mm));
  const std::size_t most = most_rings(section.height_mm);
  const std::size_t count =
      fitting_ring_count(levels, std::min(static_cast<std::size_t>(wanted), most), most);
  const double ring_mm = section.height_mm / static_cast<double>(count);
  const std::vector<Slab> slabs = on_ring_bounds(section, levels, count);
  auto rings = rings_of(sums_of(slabs, ring_mm, count), ring_mm, name);
  if (!rings) return tl::make_unexpected(rings.error());
  const Deviation deviation = deviation_between(section.slabs, slabs_of_rings(*rings, ring_mm));
  return DrawnRings{std::move(*rings), ring_mm, deviation};
}

/// Rings that are low enough for the deviation, or the highest that deviate by little more than
/// the best if none is.
Result<DrawnRings> fitted_rings(const HalfSection& section, const std::vector<double>& levels,
                                double deviation_mm, const std::string& name) {
  constexpr double kMostByItself = 30'000.0, kLowestMm = 1e-3, kLower = 0.9;
  const double lowest_mm = std::max(kLowestMm, section.height_mm / kMostByItself);
  double ring_mm = std::max(kHighestRingMm, lowest_mm);
  auto made = drawn_rings(section, levels, ring_mm, name);
  if (!made) return made;
  DrawnRings best = *made;
  // The deviation of steps is proportional to their height.
  while (ring_mm > lowest_mm && made->deviation.mm > deviation_mm - kDeviationStepMm) {
    const double before_mm = made->deviation.mm;
    const double part = 0.9 * deviation_mm / before_mm;
    ring_mm = std::max(lowest_mm, made->ring_mm * std::clamp(part, 0.1, 0.9));
    made = drawn_rings(section, levels, ring_mm, name);
    if (!made) return made;
    if (made->deviation.mm < kLower * best.deviation.mm) best = *made;
    if (ring_mm < kFineRingMm && made->deviation.mm > kLower * before_mm) break;
  }
  if (made->deviation.mm <= deviation_mm) return made;
  return best;
}

}  // namespace

std::optional<std::string> gap_warning(const ClayStack& stack) {
  const auto rings = stack.rings();
  const auto gap = std::ranges::adjacent_find(
      rings, [](const Ring& below, const Ring& above) { return !above.touches(below); });
  if (gap == rings.end()) return std::nullopt;
  const std::size_t above = static_cast<std::size_t>(gap - rings.begin()) + 1;
  return fmt::format(
      "expected a pot in one piece, found rings {} and {}, {:.4g} mm above the foot, that do not "
      "touch; a flat wall needs lower rings",
      above - 1, above, static_cast<double>(above) * stack.ring_height_mm());
}

std::vector<Slab> slabs_of(const ClayStack& stack) {
  return slabs_of_rings(stack.rings(), stack.ring_height_mm());
}

Result<DrawnPot> drawn_pot(const HalfSection& drawn, const DrawnPotSettings& settings,
                           const std::string& name) {
  const auto section = settings.wall_mm
                           ? hollowed(drawn, *settings.wall_mm, name, settings.facets_mm)
                           : Result<HalfSection>(drawn);
  if (!section) return tl::make_unexpected(section.error());
  const std::vector<double> levels = drawn_levels(*section);
  auto made = settings.ring_height_mm
                  ? drawn_rings(*section, levels, *settings.ring_height_mm, name)
                  : fitted_rings(*section, levels, settings.deviation_mm, name);
  if (!made) return tl::make_unexpected(made.error());
  const auto empty = std::ranges::find(made->rings, Quanta{0}, &Ring::outer2);
  if (empty != made->rings.end()) {
    const auto ring = static_cast<double>(empty - made->rings.begin());
    return failure(ErrorKind::bad_input,
                   fmt::format("{}: expected clay beside the axis at each height, found none at "
                               "{:g} mm",
                               name, (ring + 0.5) * made->ring_mm));
  }
  auto stack = ClayStack::from_rings(made->ring_mm, std::move(made->rings), 0);
  if (!stack)
    return failure(stack.error().kind, fmt::format("{}: {}", name, stack.error().message));
  DrawnPot result;
  result.deviation = made->deviation;
  if (settings.wall_mm) result.thinnest = thinnest_wall(*section);
  result.pot.density_g_cm3 = settings.density_g_cm3;
  result.pot.ledger.initial = stack->volume();
  result.pot.stack = std::move(*stack);
  return result;
}

}  // namespace clay::importing
