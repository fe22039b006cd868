// Stacks and tools at the limits of their ranges.

#include "app/bench/extreme/page_watch.hpp"
#include "app/bench/extreme/trial.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <vector>

namespace clay::extreme {
namespace {

Outcome reference_stroke(Model model) {
  Trial trial(model, small_pot());
  trial.stroke({40, 20, 0}, {36, 24, 0}, 40);
  trial.stroke({36, 24, 0}, {36, 36, 0}, 120);
  trial.stroke({36, 36, 0}, {36, 24, 0}, 120);
  trial.require(trial.touched(), "no contact");
  return trial.done();
}

Outcome wall_of(Model model, double wall_mm) {
  SceneSpec scene = small_pot();
  scene.lump.inner_radius_mm = 30.0 - wall_mm;
  scene.removal.min_wall_mm = 1e-3;
  Trial trial(model, scene);
  trial.stroke({40, 20, 0}, {34, 40, 0}, 100);
  trial.stroke({10, 20, 0}, {24, 40, 0}, 100);
  return trial.done();
}

Outcome wall_1e_12(Model model) { return wall_of(model, 1e-12); }

/// The thinnest wall that the engine counts: one quantum, found by bisection over the radius.
Outcome wall_of_a_quantum(Model model) {
  const double inner_mm = std::sqrt(mm2_from_quanta(quanta_from_radius(30.0) - 1));
  SceneSpec scene = small_pot();
  scene.lump.inner_radius_mm = inner_mm;
  Trial trial(model, scene);
  trial.require(!trial.refused() && trial.subject().ring(0).inner_mm < 30.0, "wall not found");
  if (const Wheel* wheel = trial.subject().wheel())
    trial.require(count_clay(*wheel) == 60, "not one quantum per ring");
  trial.stroke({40, 20, 0}, {34, 40, 0}, 100);
  trial.stroke({10, 20, 0}, {24, 40, 0}, 100);
  return trial.done();
}

Outcome no_wall(Model model) {
  SceneSpec scene = small_pot();
  scene.lump.inner_radius_mm = 30.0;
  scene.stability = StabilitySpec{10.0};
  Trial trial(model, scene);
  return trial.done();
}

/// Rings whose middle is not level with the tool must not be touched. The clay goes up, so rings
/// below must not change.
Outcome beyond_the_tool(Model model) {
  SceneSpec scene = small_pot();
  scene.tool.shape = RibSpec{10.0, 6.0};
  Trial trial(model, scene);
  trial.stroke({45, 29.8, 0}, {45, 30.2, 0}, 3);
  trial.stroke({34, 30.21, 0}, {34, 30.4, 0}, 20);
  trial.require(trial.touched(), "no contact");
  for (std::size_t i = 0; i < trial.subject().rings(); ++i)
    if (trial.subject().centre_mm(i) < 30.21 - 5.0)
      trial.require(trial.subject().ring(i).outer_mm == 30.0,
                    fmt::format("ring {} is below the tool and was pressed", i));
  return trial.done();
}

Outcome tool_wider_than_the_pot(Model model) {
  SceneSpec scene = small_pot();
  scene.tool.shape = SphereSpec{500.0};
  Trial trial(model, scene);
  trial.stroke({540, 20, 0}, {510, 40, 0}, 100);
  trial.stroke({400, 40, 0}, {200, 20, 0}, 100);
  trial.require(trial.touched(), "no contact");
  trial.require(trial.largest_force_n() <= 5.0, fmt::format("{:.3g} N", trial.largest_force_n()));
  return trial.done();
}

Outcome nothing_happens(Model model, const SceneSpec& scene,
                        const std::vector<glm::dvec3>& places) {
  Trial trial(model, scene);
  const std::string before = trial.subject().bytes();
  for (const glm::dvec3& place : places) {
    trial.stroke(place, place + glm::dvec3(0, 0.5, 0), 3);
    trial.require(trial.subject().bytes() == before, "the clay changed");
    trial.require(trial.largest_force_n() == 0.0, "a force without contact");
  }
  return trial.done();
}

Outcome tool_above(Model model) {
  return nothing_happens(model, small_pot(), {{0, 80, 0}, {25, 68.6, 0}, {10, 99'999, 0}});
}
Outcome tool_below(Model model) {
  return nothing_happens(model, small_pot(), {{0, -40, 0}, {25, -9, 0}, {10, -99'999, 0}});
}
Outcome tool_in_a_free_bore(Model model) {
  SceneSpec scene = small_pot();
  scene.lump.inner_radius_mm = 20.0;
  return nothing_happens(model, scene, {{0, 30, 0}, {8, 20, 8}, {11.5, 40, 0}});
}

Outcome index_beyond_int(Model model) {
  SceneSpec scene = small_pot();
  scene.lump.ring_height_mm = 1e-9;
  scene.flow.reach_mm = 12e-9;
  return refused_or_sound(model, scene, {36, 1e3, 0}, {36, 1e3 + 1, 0}, 3);
}

Outcome rings_of_a_micrometre(Model model) {
  SceneSpec scene = small_pot();
  scene.lump.rings = 20'000;  // 20 mm
  scene.lump.ring_height_mm = 1e-3;
  scene.tool.shape = SphereSpec{3.0};
  scene.flow.sigma_mm = 1.0;
  scene.flow.reach_mm = 4.0;
  scene.lump.max_rings = 40'000;
  Trial trial(model, scene);
  trial.stroke({34, 8, 0}, {31, 9, 0}, 20);
  trial.require(trial.touched(), "no contact");
  return trial.done(fmt::format("{} rings", trial.subject().rings()));
}

Outcome rings_of_a_metre(Model model) {
  SceneSpec scene = small_pot();
  scene.lump.rings = 5;
  scene.lump.ring_height_mm = 1e3;
  scene.tool.shape = SphereSpec{600.0};
  scene.flow.reach_mm = 3e3;
  Trial trial(model, scene);
  // Ring centres are at 500, 1500 .. mm in the engine, at 0, 1000 .. mm in the paper.
  trial.stroke({620, 900, 0}, {620, 1600, 0}, 200);
  trial.require(trial.touched(), "no contact");
  return trial.done();
}

Outcome one_ring(Model model) {
  SceneSpec scene = small_pot();
  scene.lump.rings = 1;
  scene.lump.max_rings = 100;
  Trial trial(model, scene);
  trial.stroke({45, -1, 0}, {37, 0.2, 0}, 20);
  trial.stroke({37, 0.2, 0}, {35, 0.8, 0}, 20);
  trial.require(trial.touched(), "no contact");
  return trial.done();
}

/// A stroke on very many rings; three ticks, because the suite examines every ring after each.
Outcome many_rings(Model model, std::size_t rings) {
  SceneSpec scene = small_pot();
  scene.lump.rings = rings;
  scene.lump.max_rings = rings;
  scene.lump.ring_height_mm = 0.01;
  scene.tool.shape = SphereSpec{5.0};
  const double middle_mm = 0.005 * static_cast<double>(rings);
  Trial trial(model, scene);
  trial.stroke({40, middle_mm, 0}, {34, middle_mm + 1, 0}, 2);
  trial.at({34, middle_mm, 0});
  trial.require(trial.touched(), "no contact");
  return trial.done();
}

/// Protects every page of the rings and counts those that the tick accesses. The engine has a
/// million rings; the paper has fewer, because its stress takes N^2 / 2 additions.
Outcome work_of_a_tick(Model model) {
  SceneSpec scene = small_pot();
  scene.lump.rings = model == Model::conserving ? 1'000'000 : 10'000;
  scene.lump.max_rings = scene.lump.rings;
  scene.lump.ring_height_mm = 0.3;
  scene.tool.shape = SphereSpec{5.0};
  scene.stability = StabilitySpec{1e6};
  const double y = 0.15 * static_cast<double>(scene.lump.rings);
  Trial trial(model, scene);
  trial.stroke({37, y, 0}, {34, y + 1, 0}, 5);
  const std::span<const std::byte> rings = trial.subject().ring_bytes();
  std::size_t opened = 0;
  const std::size_t all = pages_in(rings);
  for (int k = 0; k < 20 && trial.has_no_fault(); ++k) {
    const Pose pose{10'000 + 1000 * k, {33.9, y + 1 + 0.01 * k, 0}, false};
    opened = std::max(opened, pages_opened(rings, [&] { trial.subject().step(pose); }));
  }
  // Contact and kernel reach 10 mm + 2 x 12 mm, or 114 rings of at most 24 bytes; plus both ends.
  trial.require(opened >= 1 && opened <= 3, fmt::format("{} of {} pages read", opened, all));
  return trial.done(fmt::format("{} of {} pages read", opened, all));
}

Outcome million_rings(Model model) { return many_rings(model, 1'000'000); }
Outcome most_rings(Model model) { return many_rings(model, kMaxRings); }
Outcome too_many_rings(Model model) {
  if (model == Model::literal) return {Verdict::not_in_print, "the paper states no limit"};
  SceneSpec scene = small_pot();
  scene.lump.rings = kMaxRings + 1;
  Trial trial(model, scene);
  trial.require(trial.refused(), "accepted");
  return trial.done();
}

Outcome radius_1e300(Model model) {
  SceneSpec scene = small_pot();
  scene.lump.outer_radius_mm = 1e300;
  return refused_or_sound(model, scene, {1e300, 30, 0}, {1e300, 31, 0}, 3);
}

Outcome radius_1e_160(Model model) {
  SceneSpec scene = small_pot();
  scene.lump.outer_radius_mm = 1e-160;
  return refused_or_sound(model, scene, {8, 29, 0}, {7.9, 31, 0}, 20);
}

/// Presses at the largest radius, where rings have no room outside.
Outcome largest_radius(Model model) {
  SceneSpec scene = small_pot();
  scene.lump.outer_radius_mm = 5000.0;
  Trial trial(model, scene);
  trial.stroke({5008, 20, 0}, {5002, 24, 0}, 30);
  trial.stroke({5002, 24, 0}, {5002, 36, 0}, 100);
  trial.require(trial.touched(), "no contact");
  for (std::size_t i = 0; i < trial.subject().rings(); ++i)
    trial.require(trial.subject().ring(i).outer_mm <= kMaxRadiusMm,
                  fmt::format("ring {}: R = {:.8g} mm", i, trial.subject().ring(i).outer_mm));
  return trial.done();
}

constexpr Case kShapeCases[] = {
    {"reference_stroke", "an ordinary stroke, up and down", "clay conserved", "exact rationals",
     Verdict::passed, reference_stroke},
    {"wall_1e-12", "R - r = 1e-12 mm, pressed from both sides", "clay conserved, no NaN",
     "exact rationals, absolute", Verdict::passed, wall_1e_12},
    {"wall_of_a_quantum", "R^2 - r^2 = 2^-36 mm^2 in every ring", "clay conserved, r < R",
     "exact rationals, invariants", Verdict::passed, wall_of_a_quantum},
    {"no_wall", "r = R", "refused, or r < R and a finite stress", "invariants", Verdict::failed,
     no_wall},
    {"beyond_the_tool", "a rib of 10 mm height", "rings below it unchanged to the bit", "geometry",
     Verdict::failed, beyond_the_tool},
    {"tool_wider_than_the_pot", "a sphere of 500 mm on a pot of 30 mm",
     "clay conserved, at most 5 N", "exact rationals, interval", Verdict::failed,
     tool_wider_than_the_pot},
    {"tool_above", "poses above the rim, to 100 m", "no contact, state unchanged to the bit",
     "bytes", Verdict::passed, tool_above},
    {"tool_below", "poses below the wheel head, to 100 m", "no contact, state unchanged to the bit",
     "bytes", Verdict::passed, tool_below},
    {"tool_in_a_free_bore", "a tool in the bore without contact",
     "no contact, state unchanged to the bit", "bytes", Verdict::passed, tool_in_a_free_bore},
    {"index_beyond_int", "h = 1e-9 mm, y = 1 m", "refused, or no index out of range", "limits",
     Verdict::failed, index_beyond_int},
    {"rings_of_a_micrometre", "h = 1e-3 mm", "clay conserved", "exact rationals", Verdict::passed,
     rings_of_a_micrometre},
    {"rings_of_a_metre", "h = 1e3 mm, sigma = 4 mm", "clay conserved, no 0/0 of weights",
     "exact rationals", Verdict::failed, rings_of_a_metre},
    {"one_ring", "N = 1", "clay conserved", "exact rationals", Verdict::failed, one_ring},
    {"million_rings", "N = 10^6", "clay conserved; running sum = sum", "exact rationals",
     Verdict::passed, million_rings},
    {"work_of_a_tick", "N = 10^6, stress monitored", "reads only pages of nearby rings",
     "count of accessed pages", Verdict::failed, work_of_a_tick},
    {"most_rings", "N = 2^24", "clay conserved; running sum = sum", "exact rationals",
     Verdict::passed, most_rings},
    {"too_many_rings", "N = 2^24 + 1", "refused", "limits", Verdict::not_in_print, too_many_rings},
    {"radius_1e300", "R = 1e300 mm", "refused, or finite", "invariants", Verdict::failed,
     radius_1e300},
    {"radius_1e-160", "R = 1e-160 mm", "refused, or clay conserved", "exact rationals",
     Verdict::failed, radius_1e_160},
    {"largest_radius", "R = 5000 mm, the maximum", "clay conserved, R <= 5000 mm",
     "exact rationals, invariants", Verdict::failed, largest_radius},
};

}  // namespace

std::span<const Case> shape_cases() { return kShapeCases; }

}  // namespace clay::extreme
