#pragma once
#include "claystack/engine/clay_stack.hpp"

#include <cstddef>
#include <vector>

namespace clay {

/// The thinnest place of a stepped stack and the ring it starts from.
struct WallMinimum {
  double thickness_mm = 0.0;
  std::size_t ring = 0;
};

/// Least thickness [mm] of a stepped stack, exact for the steps as they are: from the bore to the
/// outside (across rings as well), through floors, lids and solid pots along the axis, and across
/// (2R) where there is no bore. Flanges that stick out are not looked at. O(N) for walls of a few
/// rings.
[[nodiscard]] WallMinimum min_wall(const ClayStack& stack);

/// [mm]; 0 without rings.
[[nodiscard]] double largest_radius_mm(const ClayStack& stack) noexcept;

/// What every ring bears [kPa], bottom to top: beta_i = g M_i / (pi (R_i^2 - r_i^2)), M_i the mass
/// of all above it, crown included (paper, section 7). To the last bit what the stability of a
/// scene compares with its StabilitySpec::max_stress_kpa.
[[nodiscard]] std::vector<double> stresses_kpa(const ClayStack& stack, double density_g_cm3);

/// What the bore that opens at the top holds when it is filled to the brim [mm^3], exact for the
/// steps as they are, of a pot in one piece; 0 where there is none, or where it goes right through.
[[nodiscard]] double capacity_mm3(const ClayStack& stack) noexcept;

}  // namespace clay
