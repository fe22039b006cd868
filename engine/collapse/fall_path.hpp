#pragma once
#include "claystack/engine/clay.hpp"
#include "claystack/engine/collapse.hpp"

#include <cstddef>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <vector>

namespace clay {

/// The plane of a fall: upright, through the axis and the HIP. On the axis every side is as good
/// as another.
struct FallPlane {
  glm::dvec3 outward{1.0, 0.0, 0.0};  ///< from the axis to the HIP
  glm::dvec2 pivot_mm{0.0};           ///< (outward, up)

  explicit FallPlane(const glm::dvec3& hip_mm) noexcept;
  /// Of the turn that carries the top away from the HIP.
  [[nodiscard]] glm::dvec3 axis() const noexcept { return {-outward.z, 0.0, outward.x}; }
};

/// The way of what stands above `failed_ring` from there to its rest; one frame where nothing does.
[[nodiscard]] std::vector<FallFrame> fall_path(const ClayStack& stack, double density_g_cm3,
                                               std::size_t failed_ring, const FallPlane& plane,
                                               double threshold_kpa);

}  // namespace clay
