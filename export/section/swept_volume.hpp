#pragma once
#include "claystack/export/section.hpp"
#include "core/compensated_sum.hpp"

#include <cstddef>
#include <numbers>

namespace clay::solid::inline section {

/// The integral of 3 rho^2 over the height along a line of points: a frustum per edge, positive
/// upward.
[[nodiscard]] inline double thrice_squared_radii(const Polygon& line, bool closed) noexcept {
  CompensatedSum sum;
  for (std::size_t i = 0; i + (closed ? 0 : 1) < line.size(); ++i) {
    const ProfilePoint& a = line[i];
    const ProfilePoint& b = line[i + 1 < line.size() ? i + 1 : 0];
    sum.add((b.y - a.y) * (a.rho * a.rho + a.rho * b.rho + b.rho * b.rho));
  }
  return sum.value();
}

/// Volume [mm^3] between a line of points and the axis, revolved once (Green's theorem: V = pi
/// times the integral of rho^2 dy).
[[nodiscard]] inline double swept_volume(const Polygon& line, bool closed) noexcept {
  return thrice_squared_radii(line, closed) * std::numbers::pi / 3.0;
}

}  // namespace clay::solid::inline section
