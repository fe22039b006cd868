#pragma once
#include "claystack/export/section.hpp"
#include "core/compensated_sum.hpp"

#include <cstddef>
#include <numbers>

namespace clay::solid::inline section {

/// Volume [mm^3] between a line of points and the axis, revolved once: a frustum per edge, positive
/// upward (Green's theorem: V = pi times the integral of rho^2 dy).
[[nodiscard]] inline double swept_volume(const Polygon& line, bool closed) noexcept {
  CompensatedSum sum;
  const std::size_t edges = line.size() - (closed ? 0 : 1);
  for (std::size_t i = 0; i < edges; ++i) {
    const ProfilePoint& a = line[i];
    const ProfilePoint& b = line[i + 1 < line.size() ? i + 1 : 0];
    sum.add((b.y - a.y) * (a.rho * a.rho + a.rho * b.rho + b.rho * b.rho));
  }
  return sum.value() * std::numbers::pi / 3.0;
}

}  // namespace clay::solid::inline section
