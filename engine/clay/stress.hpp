#pragma once
// The stress of section 7, for the tick and for reports.

#include "claystack/engine/clay.hpp"

namespace clay {

/// The factor of `stress_kpa`. rho g h: g/cm^3 = 1e-6 kg/mm^3, and kg/mm^3 m/s^2 mm = N/mm^2 =
/// 1000 kPa.
[[nodiscard]] inline double kpa_per_ratio(double density_g_cm3, double ring_height_mm) noexcept {
  return density_g_cm3 * 1e-6 * kStandardGravity * ring_height_mm * 1e3;
}

/// beta_i = g M_i / (pi (R_i^2 - r_i^2)) [kPa], M_i the mass of all above ring i, crown included.
/// The paper omits g and so compares a mass per area; with g the threshold is a stress.
[[nodiscard]] inline double stress_kpa(double per_ratio, WideQuanta above, Quanta ring) noexcept {
  return per_ratio * (static_cast<double>(above) / static_cast<double>(ring));
}

}  // namespace clay
