#include "app/history/pot_scene.hpp"

#include "claystack/engine/clay.hpp"

#include <algorithm>
#include <utility>

namespace clay::history {

SceneSpec usual_scene(double height_mm) {
  SceneSpec scene;
  scene.removal.yield_depth_mm = 2.0;
  scene.removal.min_wall_mm = 3.0;
  scene.flow = {.sigma_mm = 0.12 * height_mm, .reach_mm = 0.5 * height_mm, .inside_share = 0.25};
  scene.force->stiffness_n_per_mm2 = 0.03;
  scene.force->friction = 0.2;
  scene.clay = usual_clay();
  return scene;
}

SceneSpec scene_for(const Pot& pot, const std::string& name) {
  const double widest_mm = std::max(1.0, largest_radius_mm(pot.stack));
  SceneSpec scene = usual_scene(std::max(1.0, pot.stack.height_mm()));
  scene.name = name;
  scene.model = pot.model;
  if (pot.model == Model::paper) scene.clay.reset();
  scene.lump = {.rings = pot.stack.size(),
                .ring_height_mm = pot.stack.ring_height_mm(),
                .outer_radius_mm = widest_mm,
                .inner_radius_mm = 0.0,
                .max_rings = 0,
                .density_g_cm3 = pot.density_g_cm3};
  if (!pot.thrown_with) return scene;
  apply(*pot.thrown_with, scene);
  return scene;
}

}  // namespace clay::history
