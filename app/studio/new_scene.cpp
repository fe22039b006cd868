#include "app/studio/new_scene.hpp"

#include "app/history/pot_scene.hpp"
#include "claystack/engine/clay.hpp"

#include <numbers>

namespace clay::studio {
namespace {

constexpr double kDensity = 1.9, kStrengthKpa = 15.0;  // g/cm3, wet stoneware
constexpr std::size_t kRings = 200;

}  // namespace

double lump_height_mm(double clay_kg, double radius_mm) {
  return 1e6 * clay_kg / kDensity / (std::numbers::pi * radius_mm * radius_mm);
}

double tallest_lump_mm() noexcept { return 1e3 * kStrengthKpa / (kDensity * kStandardGravity); }

SceneSpec lump_of(double clay_kg, double radius_mm) {
  const double height_mm = lump_height_mm(clay_kg, radius_mm);
  SceneSpec scene = history::usual_scene(height_mm);
  scene.name = "lump";
  scene.lump.rings = kRings;
  scene.lump.ring_height_mm = height_mm / static_cast<double>(kRings);
  scene.lump.outer_radius_mm = radius_mm;
  scene.lump.density_g_cm3 = kDensity;
  scene.lump.max_rings = 8 * kRings;
  scene.stability = StabilitySpec{kStrengthKpa};
  return scene;
}

}  // namespace clay::studio
