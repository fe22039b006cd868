#include "claystack/engine/clay.hpp"

#include "engine/clay/stress.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <span>
#include <vector>

namespace clay {

double largest_radius_mm(const ClayStack& stack) noexcept {
  Quanta largest2 = 0;
  for (const Ring& ring : stack.rings()) largest2 = std::max(largest2, ring.outer2);
  return radius_from_quanta(largest2);
}

std::vector<double> stresses_kpa(const ClayStack& stack, double density_g_cm3) {
  const double per_ratio = kpa_per_ratio(density_g_cm3, stack.ring_height_mm());
  const auto rings = stack.rings();
  std::vector<double> stresses(rings.size());
  WideQuanta above = stack.crown();
  for (std::size_t i = rings.size(); i-- > 0; above += rings[i].volume())
    stresses[i] = stress_kpa(per_ratio, above, rings[i].volume());
  return stresses;
}

double capacity_mm3(const ClayStack& stack) noexcept {
  const auto rings = stack.rings();
  std::size_t floor = rings.size();
  WideQuanta held = 0;
  while (floor > 0 && rings[floor - 1].inner2 > 0) held += rings[--floor].inner2;
  if (floor == 0 || floor == rings.size()) return 0.0;
  const double in_crown =
      std::numbers::pi * mm2_from_quanta(rings.back().inner2) * stack.crown_height_mm();
  return static_cast<double>(held) * stack.mm3_per_quantum() + in_crown;
}

}  // namespace clay
