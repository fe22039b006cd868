#pragma once
// A tube of clay and a sphere on each side of its wall.

#include "claystack/engine/scene.hpp"
#include "claystack/engine/tool.hpp"

#include <cstdint>

namespace clay::samples {

inline constexpr double kToolMm = 8.0;  ///< radius of the sphere

inline SceneSpec tube_scene(double outer_mm, double inner_mm) {
  SceneSpec scene;
  scene.lump = {.rings = 100,
                .ring_height_mm = 0.5,
                .outer_radius_mm = outer_mm,
                .inner_radius_mm = inner_mm,
                .max_rings = 300};
  scene.tool.shape = SphereSpec{kToolMm};
  scene.tool.gap_mm = 4.0;
  scene.removal = {.rate_per_s = 40.0, .min_wall_mm = 0.5, .paper_fraction = {}};
  scene.flow = {.sigma_mm = 3.0, .reach_mm = 10.0, .inside_share = 0.4};
  return scene;
}

inline Pose pinch_at(std::int64_t time_us, glm::dvec3 hip, double gap_mm) {
  return {time_us, hip, false, gap_mm};
}

}  // namespace clay::samples
