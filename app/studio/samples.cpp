#include "app/studio/samples.hpp"

#include "app/render/pot_view.hpp"
#include "claystack/engine/files.hpp"
#include "claystack/engine/wheel.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

// The files themselves, as bytes of the program.
#define CLAYSTACK_EMBED(symbol, file)                                                      \
  __asm__(".pushsection .rodata\n" #symbol "_begin: .incbin \"" CLAYSTACK_SAMPLES "/" file \
          "\"\n" #symbol "_end: .byte 0\n.popsection\n");                                  \
  extern "C" {                                                                             \
  extern const char symbol##_begin[], symbol##_end[];                                      \
  }

CLAYSTACK_EMBED(clay_bowl_scene, "bowl.scene.json")
CLAYSTACK_EMBED(clay_bowl_session, "bowl.session")
CLAYSTACK_EMBED(clay_vase_scene, "vase.scene.json")
CLAYSTACK_EMBED(clay_vase_session, "vase.session")
CLAYSTACK_EMBED(clay_bottle_scene, "bottle.scene.json")
CLAYSTACK_EMBED(clay_bottle_session, "bottle.session")
CLAYSTACK_EMBED(clay_cylinder_scene, "cylinder.scene.json")
CLAYSTACK_EMBED(clay_cylinder_session, "cylinder.session")

namespace clay::studio {
namespace {

constexpr double kDensity = 1.9;  // g/cm3, wet stoneware
constexpr std::size_t kRings = 200;

std::string_view text(const char* begin, const char* end) {
  return {begin, static_cast<std::size_t>(end - begin)};
}

}  // namespace

const std::array<Sample, 4>& samples() {
  static const std::array<Sample, 4> all = {
      Sample{"bowl", "Bowl", "Open wide, and keep the floor",
             text(clay_bowl_scene_begin, clay_bowl_scene_end),
             text(clay_bowl_session_begin, clay_bowl_session_end)},
      Sample{"vase", "Vase", "A belly, a shoulder, a lip",
             text(clay_vase_scene_begin, clay_vase_scene_end),
             text(clay_vase_session_begin, clay_vase_session_end)},
      Sample{"bottle", "Bottle", "Collar a neck over a full body",
             text(clay_bottle_scene_begin, clay_bottle_scene_end),
             text(clay_bottle_session_begin, clay_bottle_session_end)},
      Sample{"cylinder", "Cylinder", "Pull a wall between two hands",
             text(clay_cylinder_scene_begin, clay_cylinder_scene_end),
             text(clay_cylinder_session_begin, clay_cylinder_session_end)}};
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
