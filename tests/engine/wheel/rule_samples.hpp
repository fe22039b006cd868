#pragma once
// Scenes with clay rules, random motions of a hand, and invariants.

#include "app/bench/hands/dice.hpp"
#include "claystack/engine/wheel.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <vector>

namespace clay {

inline constexpr double kH = 0.2;

inline ClaySpec no_rules() { return {false, false, false, false, false, false, 120.0, 0.0}; }

/// A thin wall of 5 mm around a bore of 40 mm radius, 120 mm high.
inline SceneSpec cylinder_scene(ClaySpec clay) {
  SceneSpec scene;
  scene.lump = {.rings = 600,
                .ring_height_mm = kH,
                .outer_radius_mm = 45.0,
                .inner_radius_mm = 40.0,
                .max_rings = 2400,
                .density_g_cm3 = 1.9};
  scene.tool = {SphereSpec{10.0}, ToolMode::press, 5.0};
  scene.removal = {20.0, 0.25, 1.0, {}};
  scene.force.reset();
  scene.clay = clay;
  return scene;
}

/// A cylinder of this height in rings of another height.
inline SceneSpec in_rings_of(double ring_height_mm, double height_mm, SceneSpec scene) {
  scene.lump.ring_height_mm = ring_height_mm;
  scene.lump.rings = static_cast<std::size_t>(height_mm / ring_height_mm + 0.5);
  scene.lump.max_rings = 2 * scene.lump.rings;
  return scene;
}

/// Mean difference between the results of `radii_in` for rings of a height and of half of it [mm].
template <class RadiiIn>
double change_by_halving(double ring_height_mm, RadiiIn radii_in) {
  const std::vector<double> coarse = radii_in(ring_height_mm),
                            fine = radii_in(0.5 * ring_height_mm);
  double sum = 0.0;
  for (std::size_t k = 0; k < fine.size(); ++k) sum += std::abs(coarse[k] - fine[k]);
  return sum / static_cast<double>(fine.size());
}

/// A wheel with a pot of these radii, `outer` and `inner` by the height of a ring's middle.
inline Wheel wheel_with(const SceneSpec& scene, double height_mm,
                        const std::function<double(double)>& outer,
                        const std::function<double(double)>& inner, double ring_height_mm = kH) {
  std::vector<Ring> rings;
  for (double up = 0.5 * ring_height_mm; up < height_mm; up += ring_height_mm)
    rings.push_back({quanta_from_radius(outer(up)), quanta_from_radius(inner(up))});
  Pot pot{ClayStack::from_rings(ring_height_mm, rings, 0, 2400).value(),
          {},
          Model::conserving,
          1.9,
          {},
          {},
          {},
          {}};
  pot.ledger.initial = pot.stack.volume();
  return Wheel::build(scene, pot).value();
}

inline double wall_of(const Ring& ring) { return ring.outer_mm() - ring.inner_mm(); }

inline void expect_balanced(const Wheel& wheel) {
  ASSERT_EQ(wheel.ledger().imbalance(wheel.stack().recount()), 0);
  ASSERT_EQ(wheel.stack().recount(), wheel.stack().volume());
}

/// A random walk about the wall with pinches, trims and jumps, past both ends of the wall.
inline std::vector<Pose> random_poses(std::uint64_t seed, int count) {
  bench::Dice dice(seed);
  std::vector<Pose> poses;
  glm::dvec3 at{30.0, 40.0, 0.0}, goal = at;
  double gap = 0.0, speed = 0.05;
  for (int k = 0; k < count; ++k) {
    if (k % 50 == 0) {
      goal = {dice.between(-10.0, 70.0), dice.between(-15.0, 95.0), 0.0};
      gap = dice.unit() < 0.4 ? dice.between(0.5, 40.0) : 0.0;
      speed = dice.unit() < 0.1 ? 5.0 : dice.between(0.01, 0.3);
    }
    const glm::dvec3 motion = goal - at;
    const double length = std::sqrt(motion.x * motion.x + motion.y * motion.y);
    if (length > speed) at += motion * (speed / length);
    poses.push_back({1000 * (k + 1), at, k % 300 > 270, gap});
  }
  return poses;
}

inline SceneSpec small_scene() {
  SceneSpec scene = cylinder_scene({});
  scene.lump = {.rings = 150,
                .ring_height_mm = 0.5,
                .outer_radius_mm = 40.0,
                .inner_radius_mm = 30.0,
                .max_rings = 600,
                .density_g_cm3 = 1.9};
  scene.removal = {20.0, 2.0, 3.0, {}};
  scene.force = ForceSpec{};
  scene.stability = StabilitySpec{1e6};
  return scene;
}

}  // namespace clay
