#pragma once
// Points with one place: formats repeat a point for each triangle, and repairs bring points
// together.

#include <cstddef>
#include <cstdint>
#include <glm/vec3.hpp>
#include <vector>

namespace clay::solid {

struct EqualPoints {
  std::vector<std::uint32_t> first;  ///< for each point the first with the same place
  std::size_t repeated = 0;          ///< points that are not the first of their place
};

/// By float32 coordinates, as `VertexWelder`. Points are finite.
[[nodiscard]] EqualPoints equal_points(const std::vector<glm::dvec3>& points);

}  // namespace clay::solid
