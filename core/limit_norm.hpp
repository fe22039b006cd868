#pragma once
// The one clamp for the length of a force: the engine, the guard and the devices use it.

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/vec3.hpp>
#include <limits>

namespace clay {

[[nodiscard]] inline bool is_finite(const glm::dvec3& v) noexcept {
  return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z);
}

/// The largest absolute component.
[[nodiscard]] inline double largest(const glm::dvec3& v) noexcept {
  return std::max({std::abs(v.x), std::abs(v.y), std::abs(v.z)});
}

/// Length without intermediate overflow: infinite or NaN only if the true length is.
[[nodiscard]] inline double norm(const glm::dvec3& v) noexcept {
  const double most = largest(v);
  return most > 0.0 ? most * glm::length(v / most) : most;
}

/// Margin of a limited norm, so that no rounding, here or in a caller's sum of its parts, exceeds
/// the limit.
inline constexpr double kJustBelow = 1.0 - 8.0 * std::numeric_limits<double>::epsilon();

/// Shortens `v` to `limit`, keeping its direction. The result is not longer than `limit` in exact
/// arithmetic; a shortened vector is up to 2^-48 (relative) too short. Zero if `v` is not finite.
[[nodiscard]] inline glm::dvec3 limit_norm(const glm::dvec3& v, double limit) noexcept {
  // No vector is longer than its components together: most forces need no root.
  if (std::abs(v.x) + std::abs(v.y) + std::abs(v.z) < 0.99 * limit) return v;
  if (!is_finite(v)) return glm::dvec3(0.0);
  if (norm(v) <= kJustBelow * limit) return v;
  const glm::dvec3 direction = v / largest(v);
  return direction * (kJustBelow * limit / glm::length(direction));
}

}  // namespace clay
