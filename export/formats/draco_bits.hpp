#pragma once
#include "claystack/export/solid.hpp"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>

namespace clay::solid::inline formats {

inline constexpr int kMinDracoBits = 8;
inline constexpr int kDracoBitsStep = 2;
inline constexpr int kMaxDracoBits = 30;  // Draco's own limit

/// The smallest number of bits that separates the ends of the shortest edge on Draco's grid, which
/// covers all points, also those without a triangle. Requires at least one.
[[nodiscard]] inline int least_draco_bits(const TriangleMesh& mesh) {
  glm::dvec3 low = mesh.points.front(), high = low;
  for (const glm::dvec3& p : mesh.points) {
    low = glm::min(low, p);
    high = glm::max(high, p);
  }
  const glm::dvec3 sides = high - low;
  const double range = std::max({sides.x, sides.y, sides.z});
  double shortest = range;
  for (const auto& t : mesh.triangles)
    for (std::size_t c = 0; c < 3; ++c)
      shortest = std::min(shortest, glm::distance(mesh.points[t[c]], mesh.points[t[(c + 1) % 3]]));
  const int bits = static_cast<int>(std::ceil(std::min(std::log2(range / shortest + 1.0), 30.0)));
  return std::max(bits, kMinDracoBits);
}

}  // namespace clay::solid::inline formats
