#include "app/studio/new_scene.hpp"

#include <algorithm>
#include <numbers>

namespace clay::studio {
namespace {

constexpr double kDensity = 1.9;  // g/cm3, wet stoneware
constexpr std::size_t kRings = 200;
constexpr double kFloorMm = 5.0;  // usual for a pot that is not trimmed on its foot

/// The settings of the clay, for a lump or a pot of a height.
SceneSpec scene_of_height(double height_mm) {
  SceneSpec scene;
  scene.removal.yield_depth_mm = 2.0;
  scene.removal.min_wall_mm = 3.0;
  scene.flow = {.sigma_mm = 0.12 * height_mm, .reach_mm = 0.5 * height_mm, .inside_share = 0.25};
  scene.force->stiffness_n_per_mm2 = 0.03;
  scene.force->friction = 0.2;
  scene.clay = ClaySpec{.floor_mm = kFloorMm};
  return scene;
}

}  // namespace

double lump_height_mm(double clay_kg, double radius_mm) {
  return 1e6 * clay_kg / kDensity / (std::numbers::pi * radius_mm * radius_mm);
}

SceneSpec lump_of(double clay_kg, double radius_mm) {
  const double height_mm = lump_height_mm(clay_kg, radius_mm);
  SceneSpec scene = scene_of_height(height_mm);
  scene.name = "lump";
  scene.lump.rings = kRings;
  scene.lump.ring_height_mm = height_mm / static_cast<double>(kRings);
  scene.lump.outer_radius_mm = radius_mm;
  scene.lump.density_g_cm3 = kDensity;
  scene.lump.max_rings = 8 * kRings;
  scene.stability = StabilitySpec{15.0};
  return scene;
}

SceneSpec scene_for(const Pot& pot, const std::string& name) {
  double widest_mm = 1.0;
  for (const Ring& ring : pot.stack.rings()) widest_mm = std::max(widest_mm, ring.outer_mm());
  SceneSpec scene = scene_of_height(std::max(1.0, pot.stack.height_mm()));
  scene.name = name;
  scene.model = pot.model;
  if (pot.model == Model::paper) scene.clay.reset();
  scene.lump = {.rings = pot.stack.size(),
                .ring_height_mm = pot.stack.ring_height_mm(),
                .outer_radius_mm = widest_mm,
                .inner_radius_mm = 0.0,
                .max_rings = 0,
                .density_g_cm3 = pot.density_g_cm3};
  return scene;
}

}  // namespace clay::studio
