// The clay rules at their limits: very thin walls and floors, slender and thick shells, very low
// and very high rings, ticks of 1 us to 10 s.

#include "app/bench/extreme/trial.hpp"
#include "claystack/engine/wheel.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace clay::extreme {
namespace {

// The radius of a bore of one quantum, rounded up.
constexpr double kRoundingMm = 4e-6;

/// The small pot with a bore of 20 mm and all rules.
SceneSpec ruled_pot(double inner_mm = 20.0) {
  SceneSpec scene = small_pot();
  scene.lump.inner_radius_mm = inner_mm;
  scene.tool.gap_mm = 5.0;  // poses may pinch
  scene.clay = ClaySpec{};
  return scene;
}

double thinnest_mm(const Wheel& wheel) {
  double least = 1e300;
  for (const Ring& ring : wheel.stack().rings())
    least = std::min(least, ring.outer_mm() - ring.inner_mm());
  return least;
}

/// Plays a hand on a scene. In addition to the checks of every trial, no wall may become thinner
/// than the minimum, or than before.
template <class Play>
Outcome with_rules(Model model, const SceneSpec& scene, Play play) {
  if (model == Model::literal) return {Verdict::not_in_print, "the paper has no such rules"};
  Trial trial(model, scene);
  trial.require(!trial.refused(), trial.why());
  if (!trial.has_no_fault()) return trial.done();
  const Wheel& wheel = *trial.subject().wheel();
  const double least = std::min(scene.removal.min_wall_mm, thinnest_mm(wheel)) - kRoundingMm;
  play(trial);
  trial.require(trial.touched(), "no contact");
  const double thinnest = thinnest_mm(wheel);
  trial.require(thinnest >= least, fmt::format("a wall of {:.6g} mm", thinnest));
  return trial.done();
}

/// Presses into the middle of the pot from outside, up, and down past the foot; then from inside.
void press_all(Trial& trial, double R = 30.0, double r = 20.0, double height = 60.0) {
  const double y = 0.5 * height, a = 8.0;
  trial.stroke({R + a + 2.0, y, 0}, {R + a - 3.0, y, 0}, 60);
  trial.stroke({R + a - 3.0, y, 0}, {R + a - 3.0, height + 2.0, 0}, 150);
  trial.stroke({R + a - 3.0, 0.3 * height, 0}, {R + a - 4.0, -2.0, 0}, 100);
  trial.stroke({r - a - 1.0, y, 0}, {r - a + 3.0, y, 0}, 60);
  trial.stroke({r - a + 3.0, y, 0}, {r - a + 3.0, height + 2.0, 0}, 150);
}

/// A pull between two tools from the foot to the rim.
void pull(Trial& trial, double middle, double gap, double height = 60.0) {
  trial.pinch(gap);
  trial.stroke({middle, 9.0, 0}, {middle, height + 12.0, 0}, 400);
  trial.pinch(0.0);
}

Outcome tool_across_the_axis(Model model) {
  return with_rules(model, ruled_pot(), [](Trial& trial) {
    trial.stroke({15, 30, 0}, {-15, 34, 0}, 200);
    trial.stroke({0, 30, -15}, {0, 34, 15}, 200);
  });
}

Outcome fingers_across_the_axis(Model model) {
  return with_rules(model, ruled_pot(), [](Trial& trial) {
    trial.pinch(30.0);
    trial.stroke({20, 30, 0}, {-6, 34, 0}, 300);
  });
}

Outcome fingers_wider_than_the_pot(Model model) {
  return with_rules(model, ruled_pot(), [](Trial& trial) {
    trial.pinch(200.0);
    trial.stroke({80, 30, 0}, {0, 34, 0}, 100);
    pull(trial, 25.0, 6.0);
  });
}

Outcome wall_of_one_quantum(Model model) {
  SceneSpec scene = ruled_pot(29.9999999999998);
  return with_rules(model, scene, [](Trial& trial) { press_all(trial, 30.0, 30.0); });
}

/// Walls from the full radius to a thousandth of it.
template <int over>
Outcome slender(Model model) {
  const double wall = 30.0 / over;
  SceneSpec scene = ruled_pot(std::max(30.0 - wall, 0.0));
  scene.removal.min_wall_mm = std::min(0.5, 0.5 * wall);
  return with_rules(model, scene, [wall](Trial& trial) {
    press_all(trial, 30.0, 30.0 - wall);
    pull(trial, 30.0 - 0.5 * wall, 0.7 * wall);
  });
}

Outcome floor_of_one_ring(Model model) {
  SceneSpec scene = ruled_pot(0.0);
  scene.clay->floor_mm = 1.0;
  return with_rules(model, scene, [](Trial& trial) {
    trial.stroke({1, 70, 0}, {1, 0, 0}, 400);
    trial.stroke({1, 0, 0}, {14, 0, 0}, 200);
    trial.require(trial.subject().ring(0).inner_mm == 0.0, "the floor is open");
    trial.require(trial.subject().ring(5).inner_mm > 0.0, "no bore above the floor");
  });
}

Outcome floor_above_the_rim(Model model) {
  SceneSpec scene = ruled_pot(0.0);
  scene.clay->floor_mm = 1e6;
  return with_rules(model, scene, [](Trial& trial) {
    trial.stroke({1, 70, 0}, {1, 20, 0}, 200);
    trial.stroke({40, 20, 0}, {34, 30, 0}, 100);
    for (std::size_t i = 0; i < 60; ++i)
      trial.require(trial.subject().ring(i).inner_mm == 0.0, "a bore below the floor's height");
  });
}

Outcome rim_between_the_fingers(Model model) {
  return with_rules(model, ruled_pot(), [](Trial& trial) {
    trial.pinch(5.0);
    trial.stroke({25, 60, 0}, {25, 66, 0}, 500);
    trial.stroke({25, 66, 0}, {25, 58, 0}, 500);
  });
}

/// The tool is over the rim; clay pushed up from below must not rise into it.
Outcome tool_above_the_rim(Model model) {
  return with_rules(model, ruled_pot(), [](Trial& trial) {
    trial.stroke({36, 66, 0}, {30, 62, 0}, 300);
    trial.stroke({30, 62, 0}, {26, 58, 0}, 600);
  });
}

/// Rings from 1 um to 50 mm height, in a pot of 10 to 300 mm.
template <int per_mm, int rings>
Outcome ring_height(Model model) {
  SceneSpec scene = ruled_pot();
  scene.lump.ring_height_mm = per_mm > 0 ? 1.0 / per_mm : 50.0;
  scene.lump.rings = rings;
  scene.lump.max_rings = 4 * static_cast<std::size_t>(rings);
  scene.flow.sigma_mm = 4.0 * scene.lump.ring_height_mm;
  scene.flow.reach_mm = 12.0 * scene.lump.ring_height_mm;
  const double height = rings * scene.lump.ring_height_mm;
  return with_rules(model, scene, [height](Trial& trial) {
    trial.stroke({40, 0.5 * height, 0}, {35, 0.5 * height, 0}, 20);
    trial.stroke({35, 0.5 * height, 0}, {35, 0.9 * height, 0}, 20);
    trial.pinch(7.0);
    trial.stroke({25, 0.4 * height, 0}, {25, 0.6 * height, 0}, 20);
  });
}

template <int dt_us>
Outcome tick_of(Model model) {
  return with_rules(model, ruled_pot(), [](Trial& trial) {
    for (int k = 0; k < 400; ++k) {
      const double part = k / 400.0;
      trial.at({39.0 - 6.0 * part, 25.0 + 10.0 * part, 0}, false, dt_us);
    }
    trial.pinch(6.0);
    for (int k = 0; k < 400; ++k) trial.at({25.0, 10.0 + 0.15 * k, 0}, false, dt_us);
  });
}

Outcome leaps(Model model) {
  return with_rules(model, ruled_pot(), [](Trial& trial) {
    for (int k = 0; k < 200; ++k) trial.at({k % 2 ? 33.0 : 8.0, (k * 37) % 70 - 5.0, 0});
    for (int k = 0; k < 200; ++k) {
      trial.pinch(k % 3 ? 0.0 : 5.0);
      trial.at({k % 2 ? 300.0 : 25.0, (k * 53) % 70 - 5.0, 0});
    }
  });
}

Outcome fast_wheel(Model model) {
  SceneSpec scene = ruled_pot();
  scene.clay->wheel_rpm = 1000.0;
  return with_rules(model, scene, [](Trial& trial) { press_all(trial); });
}

Outcome wheel_at_rest(Model model) {
  SceneSpec scene = ruled_pot();
  scene.clay->wheel_rpm = 0.0;
  return with_rules(model, scene, [](Trial& trial) { press_all(trial); });
}

Outcome lift_without_room(Model model) {
  SceneSpec scene = ruled_pot();
  scene.lump.max_rings = 60;
  return with_rules(model, scene, [](Trial& trial) {
    trial.pinch(4.0);
    trial.stroke({25, 9, 0}, {25, 50, 0}, 1000);
    trial.require(trial.last().ring_limit, "the limit is not reported");
    trial.require(trial.subject().rings() == 60, "grown beyond the limit");
  });
}

/// Pushes every ring outward until the clay is at rest; the rim sinks and rings are removed.
Outcome bellied_to_the_end(Model model) {
  SceneSpec scene = ruled_pot(26.0);
  scene.tool.shape = RibSpec{130.0, 8.0};
  return with_rules(model, scene, [](Trial& trial) {
    trial.stroke({17, 30, 0}, {60, 30, 0}, 2000);
    trial.require(trial.subject().rings() < 60, "no ring was removed");
  });
}

Outcome collared_to_a_closed_neck(Model model) {
  return with_rules(model, ruled_pot(26.0), [](Trial& trial) {
    for (int pass = 0; pass < 6; ++pass)
      trial.stroke({38.0 - 5.0 * pass, 45, 0}, {33.0 - 5.0 * pass, 55, 0}, 200);
  });
}

Outcome clay_like_water(Model model) {
  SceneSpec scene = ruled_pot();
  scene.removal.rate_per_s = 1e6;
  scene.removal.yield_depth_mm = 1e-6;
  return with_rules(model, scene, [](Trial& trial) { press_all(trial); });
}

Outcome rib_as_high_as_the_pot(Model model) {
  SceneSpec scene = ruled_pot();
  scene.tool.shape = RibSpec{80.0, 8.0};
  return with_rules(model, scene, [](Trial& trial) {
    trial.stroke({40, 30, 0}, {33, 31, 0}, 300);
    trial.stroke({9, 30, 0}, {16, 29, 0}, 300);
  });
}

Outcome pot_of_five_metres(Model model) {
  SceneSpec scene = ruled_pot(4980.0);
  scene.lump.outer_radius_mm = 4999.0;
  scene.lump.ring_height_mm = 10.0;
  return with_rules(model, scene, [](Trial& trial) {
    trial.stroke({5009, 300, 0}, {5000, 305, 0}, 200);
    trial.stroke({4970, 300, 0}, {5005, 305, 0}, 400);
  });
}

/// Presses the whole wall outward where nothing can be squeezed out of it, by leaps too.
Outcome thin_wall_pressed(Model model) {
  SceneSpec scene = ruled_pot(27.0);
  scene.removal.min_wall_mm = 3.0;
  scene.clay->thin_wall_yields = true;
  return with_rules(model, scene, [](Trial& trial) {
    trial.stroke({18, 30, 0}, {40, 30, 0}, 300);
    trial.stroke({40, 30, 0}, {40, 70, 0}, 100);
    trial.stroke({18, 10, 0}, {80, 12, 0}, 3);
  });
}

/// Cuts a rim at its minimum from both sides, down to the foot, in rings of this height.
template <int per_mm, std::size_t rings>
Outcome thin_rim_cut(Model model) {
  SceneSpec scene = ruled_pot();
  scene.tool.mode = ToolMode::trim;
  scene.removal.min_wall_mm = 3.0;
  scene.lump.rings = rings;
  scene.lump.ring_height_mm = 1.0 / per_mm;
  scene.lump.max_rings = 2 * rings;
  scene.clay->thin_wall_yields = true;
  const double top = static_cast<double>(rings) / per_mm;
  return with_rules(model, scene, [top](Trial& trial) {
    for (const double down : {4.0, 2.0, 0.0, -2.0, -20.0}) {
      trial.stroke({38, top + 2, 0}, {20, top + down, 0}, 150);
      trial.stroke({10, top + 2, 0}, {30, top + down, 0}, 150);
    }
  });
}

/// Under a tool at rest the clay comes to rest.
Outcome still_tool(Model model) {
  return with_rules(model, ruled_pot(), [](Trial& trial) {
    trial.stroke({40, 30, 0}, {34, 30, 0}, 100);
    trial.stroke({34, 30, 0}, {34, 30, 0}, 20'000);
    const Radii before = trial.subject().ring(30);
    trial.stroke({34, 30, 0}, {34, 30, 0}, 1000);
    const Radii after = trial.subject().ring(30);
    trial.require(std::abs(before.outer_mm - after.outer_mm) < 1e-3, "the wall still moves");
  });
}

Outcome twice_the_same(Model model) {
  if (model == Model::literal) return {Verdict::not_in_print, "the paper has no such rules"};
  std::string bytes[2];
  for (std::string& end : bytes) {
    Trial trial(model, ruled_pot());
    press_all(trial);
    pull(trial, 25.0, 6.0);
    end = trial.subject().bytes();
  }
  Trial trial(model, ruled_pot());
  trial.require(bytes[0] == bytes[1], "two runs differ");
  return trial.done();
}

constexpr const char* kSound = "clay conserved, walls at least the minimum, finite force";
constexpr const char* kExact = "exact rationals, invariants";

constexpr Case rule_case(std::string_view name, std::string_view what, Outcome (*run)(Model)) {
  return {name, what, kSound, kExact, Verdict::not_in_print, run};
}

constexpr Case kRuleCases[] = {
    rule_case("rules_tool_across_the_axis", "a tool in the bore, across the axis and back",
              tool_across_the_axis),
    rule_case("rules_fingers_across_the_axis", "two tools, the inner one beyond the axis",
              fingers_across_the_axis),
    rule_case("rules_fingers_wider_than_the_pot", "a gap of 200 mm, then a pull",
              fingers_wider_than_the_pot),
    rule_case("rules_wall_of_one_quantum", "a wall of 2e-13 mm", wall_of_one_quantum),
    rule_case("rules_slender_1", "R / w = 1", slender<1>),
    rule_case("rules_slender_10", "R / w = 10", slender<10>),
    rule_case("rules_slender_100", "R / w = 100", slender<100>),
    rule_case("rules_slender_1000", "R / w = 1000", slender<1000>),
    rule_case("rules_floor_of_one_ring", "floor_mm = h, a hand through the floor",
              floor_of_one_ring),
    rule_case("rules_floor_above_the_rim", "floor_mm = 1 km", floor_above_the_rim),
    rule_case("rules_rim_between_the_fingers", "a pinch at the rim, up and down",
              rim_between_the_fingers),
    rule_case("rules_tool_above_the_rim", "a tool over the rim, pressed down and in",
              tool_above_the_rim),
    rule_case("rules_h_1_um", "h = 1 um, 10 000 rings", ring_height<1000, 10'000>),
    rule_case("rules_h_10_um", "h = 10 um, 6000 rings", ring_height<100, 6000>),
    rule_case("rules_h_50_mm", "h = 50 mm, 6 rings", ring_height<0, 6>),
    rule_case("rules_dt_1_us", "ticks of 1 us", tick_of<1>),
    rule_case("rules_dt_50_ms", "ticks of 50 ms", tick_of<50'000>),
    rule_case("rules_dt_10_s", "ticks of 10 s", tick_of<10'000'000>),
    rule_case("rules_leaps", "jumps from side to side, one and two tools", leaps),
    rule_case("rules_fast_wheel", "1000 rpm", fast_wheel),
    rule_case("rules_wheel_at_rest", "the wheel does not turn", wheel_at_rest),
    rule_case("rules_lift_without_room", "a pull with max_rings reached", lift_without_room),
    rule_case("rules_bellied_to_the_end", "a rib pushes the whole wall outward",
              bellied_to_the_end),
    rule_case("rules_collared_to_a_closed_neck", "six collaring strokes to the axis",
              collared_to_a_closed_neck),
    rule_case("rules_clay_like_water", "kappa dt = 1000, yield depth 1 nm", clay_like_water),
    rule_case("rules_rib_as_high_as_the_pot", "a rib over the whole wall, from both sides",
              rib_as_high_as_the_pot),
    rule_case("rules_pot_of_five_metres", "R = 4999 mm", pot_of_five_metres),
    rule_case("rules_thin_wall_pressed", "a wall at its minimum, pressed outward and by leaps",
              thin_wall_pressed),
    rule_case("rules_thin_rim_cut_1_mm", "a rim at its minimum, cut away, h = 1 mm",
              thin_rim_cut<1, 60>),
    rule_case("rules_thin_rim_cut_10_um", "the same, h = 10 um", thin_rim_cut<100, 3000>),
    rule_case("rules_still_tool", "a tool at rest in the clay for 20 s", still_tool),
    rule_case("rules_twice_the_same", "the same strokes twice", twice_the_same),
};

}  // namespace

std::span<const Case> rule_cases() { return kRuleCases; }

}  // namespace clay::extreme
