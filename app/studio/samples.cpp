#include "app/studio/samples.hpp"

#include "app/render/pot_view.hpp"
#include "claystack/engine/files.hpp"
#include "claystack/engine/wheel.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

// Generated from the files of samples/ by the build.
namespace clay::studio::embedded {
extern const std::string_view bowl_scene_json, bowl_session;
extern const std::string_view vase_scene_json, vase_session;
extern const std::string_view bottle_scene_json, bottle_session;
extern const std::string_view cylinder_scene_json, cylinder_session;
}  // namespace clay::studio::embedded

namespace clay::studio {
namespace {

constexpr double kDensity = 1.9;  // g/cm3, wet stoneware
constexpr std::size_t kRings = 200;

}  // namespace

const std::array<Sample, 4>& samples() {
  static const std::array<Sample, 4> all = {
      Sample{"bowl", "Bowl", "Open wide, and keep the floor", embedded::bowl_scene_json,
             embedded::bowl_session},
      Sample{"vase", "Vase", "A belly, a shoulder, a lip", embedded::vase_scene_json,
             embedded::vase_session},
      Sample{"bottle", "Bottle", "Collar a neck over a full body", embedded::bottle_scene_json,
             embedded::bottle_session},
      Sample{"cylinder", "Cylinder", "Pull a wall between two hands", embedded::cylinder_scene_json,
             embedded::cylinder_session}};
  return all;
}

const Sample* find_sample(std::string_view name) {
  const auto found = std::ranges::find(samples(), name, &Sample::name);
  return found == samples().end() ? nullptr : &*found;
}

Result<SceneSpec> scene_of(const Sample& sample) {
  return parse_scene(sample.scene_text, sample.name);
}

Result<render::PotView> finished(const Sample& sample) {
  const auto scene = scene_of(sample);
  if (!scene) return tl::make_unexpected(scene.error());
  const auto session = parse_session(sample.session_text, sample.name);
  if (!session) return tl::make_unexpected(session.error());
  auto wheel = Wheel::build(*scene);
  if (!wheel) return tl::make_unexpected(wheel.error());
  for (const Pose& pose : session->poses) wheel->step(pose);
  return render::view_of(wheel->pot());
}

double lump_height_mm(double clay_kg, double radius_mm) {
  return 1e6 * clay_kg / kDensity / (std::numbers::pi * radius_mm * radius_mm);
}

SceneSpec lump_of(double clay_kg, double radius_mm) {
  const double height_mm = lump_height_mm(clay_kg, radius_mm);
  SceneSpec scene;
  scene.name = "lump";
  scene.lump.rings = kRings;
  scene.lump.ring_height_mm = height_mm / static_cast<double>(kRings);
  scene.lump.outer_radius_mm = radius_mm;
  scene.lump.density_g_cm3 = kDensity;
  scene.lump.max_rings = 8 * kRings;
  scene.removal.yield_depth_mm = 2.0;
  scene.removal.min_wall_mm = 3.0;
  scene.flow = {.sigma_mm = 0.12 * height_mm, .reach_mm = 0.5 * height_mm, .inside_share = 0.25};
  scene.force->stiffness_n_per_mm2 = 0.03;
  scene.force->friction = 0.2;
  scene.stability = StabilitySpec{15.0};
  return scene;
}

}  // namespace clay::studio
