#include "app/import/drawn_pot.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace clay::importing {
namespace {

/// The part of a slab between two heights.
Slab part_of(const Slab& slab, double from, double to) {
  const auto along = [&](double a, double b, double y) {
    return a + (b - a) * ((y - slab.from_mm) / (slab.to_mm - slab.from_mm));
  };
  return {from,
          to,
          along(slab.outer_from_mm, slab.outer_to_mm, from),
          along(slab.outer_from_mm, slab.outer_to_mm, to),
          along(slab.inner_from_mm, slab.inner_to_mm, from),
          along(slab.inner_from_mm, slab.inner_to_mm, to)};
}

/// Calls `use(ring, part)` for each part of a slab that lies within one ring, bottom to top.
template <class Use>
void for_each_part(const HalfSection& section, double ring_mm, std::size_t count, Use use) {
  std::size_t ring = 0;
  for (const Slab& slab : section.slabs) {
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

void hollow(std::vector<Ring>& rings, double ring_mm, double wall_mm) {
  for (std::size_t i = 0; i < rings.size(); ++i) {
    const double bore = rings[i].outer_mm() - wall_mm;
    if (static_cast<double>(i) * ring_mm >= wall_mm && bore > 0.0)
      rings[i].inner2 = quanta_from_radius(bore);
  }
}

/// Squares of the radii over the height of each ring.
struct RingSums {
  std::vector<Squares> rings;
  bool bored = false;  ///< the drawing has an inside
};

RingSums sums_of(const HalfSection& section, double ring_mm, std::size_t count) {
  RingSums sums{std::vector<Squares>(count)};
  for_each_part(section, ring_mm, count, [&](std::size_t ring, const Slab& part) {
    const double height = part.to_mm - part.from_mm;
    sums.rings[ring].outer += squares(height, part.outer_from_mm, part.outer_to_mm);
    sums.rings[ring].inner += squares(height, part.inner_from_mm, part.inner_to_mm);
    sums.bored = sums.bored || part.inner_from_mm > 0.0 || part.inner_to_mm > 0.0;
  });
  return sums;
}

Result<std::vector<Ring>> rings_of(const RingSums& sums, double ring_mm, const std::string& name) {
  std::vector<Ring> rings;
  for (const Squares& sum : sums.rings) {
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

}  // namespace

Result<Pot> drawn_pot(const HalfSection& section, const DrawnPotSettings& settings,
                      const std::string& name) {
  const double rings_wanted =
      std::max(1.0, std::round(section.height_mm / settings.ring_height_mm));
  if (!(rings_wanted <= static_cast<double>(kMaxRings)))
    return failure(ErrorKind::bad_input,
                   fmt::format("{}: expected at most {} rings, found {:g} mm in rings of {:g} mm",
                               name, kMaxRings, section.height_mm, settings.ring_height_mm));
  const auto count = static_cast<std::size_t>(rings_wanted);
  const double ring_mm = section.height_mm / rings_wanted;
  const RingSums sums = sums_of(section, ring_mm, count);
  if (sums.bored && settings.wall_mm)
    return failure(ErrorKind::bad_input,
                   name + ": --wall: expected a drawing of the outside alone, found a bore in it");
  auto rings = rings_of(sums, ring_mm, name);
  if (!rings) return tl::make_unexpected(rings.error());
  if (settings.wall_mm) hollow(*rings, ring_mm, *settings.wall_mm);
  auto stack = ClayStack::from_rings(ring_mm, std::move(*rings), 0);
  if (!stack)
    return failure(stack.error().kind, fmt::format("{}: {}", name, stack.error().message));
  Pot pot;
  pot.density_g_cm3 = settings.density_g_cm3;
  pot.ledger.initial = stack->volume();
  pot.stack = std::move(*stack);
  return pot;
}

}  // namespace clay::importing
