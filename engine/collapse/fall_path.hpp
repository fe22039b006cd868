#pragma once
#include "claystack/engine/clay.hpp"
#include "claystack/engine/collapse.hpp"

#include <cstddef>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <vector>

namespace clay {

/// The plane of a collapse: vertical, through the axis and the HIP. If the HIP is on the axis, any
/// direction is valid.
struct FallPlane {
  glm::dvec3 outward{1.0, 0.0, 0.0};  ///< from the axis to the HIP
  glm::dvec2 pivot_mm{0.0};           ///< (outward, up)

  explicit FallPlane(const glm::dvec3& hip_mm) noexcept;
  /// Axis of the rotation that moves the top away from the HIP.
  [[nodiscard]] glm::dvec3 axis() const noexcept { return {-outward.z, 0.0, outward.x}; }
};

/// The motion of the part above `failed_ring` to its resting place; one frame if there is no such
/// part.
[[nodiscard]] std::vector<FallFrame> fall_path(const ClayStack& stack, double density_g_cm3,
                                               std::size_t failed_ring, const FallPlane& plane,
                                               double threshold_kpa);

}  // namespace clay
