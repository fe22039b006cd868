#pragma once
#include <cstdint>
#include <glm/vec3.hpp>

namespace clay {

/// One sample of the tool: the HIP at a time. A pinch has two tools, one on either side of a wall;
/// the HIP is then the middle of the gap between them.
struct Pose {
  std::int64_t time_us = 0;     ///< since the session began
  glm::dvec3 position_mm{0.0};  ///< y up, the wheel head at y = 0, the axis at x = z = 0
  bool trim = false;            ///< button: cut clay off instead of pressing it aside
  double gap_mm = 0.0;          ///< above 0: two tools, so far apart at their widest; 0: one tool
  friend bool operator==(const Pose&, const Pose&) = default;
};

}  // namespace clay
