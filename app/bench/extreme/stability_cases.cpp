// The stress threshold to one ulp, and collapse at both ends.

#include "app/bench/extreme/trial.hpp"
#include "app/bench/literal/literal_paper.hpp"
#include "claystack/engine/wheel.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

namespace clay::extreme {
namespace {

/// A stroke that cuts a neck at this height.
std::vector<Pose> neck(double y_mm) {
  std::vector<Pose> poses;
  for (int k = 0; k < 150; ++k)
    poses.push_back({1000 * (k + 1), {37.0 - 0.1 * k, y_mm + 1e-4 * k, 0.0}, false});
  return poses;
}

SceneSpec neck_scene(double max_stress_kpa) {
  SceneSpec scene = small_pot();
  scene.tool.shape = SphereSpec{4.0};
  scene.removal.rate_per_s = 40.0;
  scene.stability = StabilitySpec{max_stress_kpa};
  return scene;
}

/// The largest beta of a stack [kPa], with M summed from the top in integers, then rounded as in
/// the model: rho g h (M / ring). Also in 50 digits, as a check.
struct Largest {
  double kpa = 0.0;
  Fifty exact = 0;
};

Largest largest_stress(const ClayStack& stack, double density_g_cm3) {
  const double scale = density_g_cm3 * 1e-6 * 9.80665 * stack.ring_height_mm() * 1e3;
  const Fifty exact_scale =
      Fifty(density_g_cm3) * Fifty(stack.ring_height_mm()) * Fifty("9.80665e-3");
  Largest largest;
  WideQuanta above = stack.crown();
  for (std::size_t i = stack.size(); i-- > 0;) {
    const Quanta ring = stack.rings()[i].outer2 - stack.rings()[i].inner2;
    largest.kpa =
        std::max(largest.kpa, scale * (static_cast<double>(above) / static_cast<double>(ring)));
    largest.exact =
        std::max(largest.exact, Fifty(exact_scale * (Fifty(count_of(above)) / Fifty(Count(ring)))));
    above += ring;
  }
  return largest;
}

/// The tick at which a wheel with this threshold collapses; the number of poses if it holds.
std::size_t tick_of_collapse(double max_stress_kpa, const std::vector<Pose>& poses) {
  Wheel wheel = Wheel::build(neck_scene(max_stress_kpa)).value();
  std::size_t tick = 0;
  while (tick < poses.size() && !(wheel.step(poses[tick]).flags & kCollapsed)) ++tick;
  return tick;
}

Outcome threshold_of_the_engine() {
  const std::vector<Pose> poses = neck(20.5);
  Wheel wheel = Wheel::build(neck_scene(1e6)).value();
  double largest_kpa = 0.0;
  std::size_t when = 0;
  for (std::size_t k = 0; k < poses.size(); ++k) {
    wheel.step(poses[k]);
    const Largest now = largest_stress(wheel.stack(), 1.9);
    const double ulps = std::abs((Fifty(now.kpa) / now.exact - 1).convert_to<double>()) * 0x1p52;
    if (ulps > 4.0) return {Verdict::failed, fmt::format("{:.2g} ulp from 50 digits", ulps)};
    if (now.kpa > largest_kpa) {
      largest_kpa = now.kpa;
      when = k;
    }
  }
  if (tick_of_collapse(largest_kpa, poses) != poses.size())
    return {Verdict::failed, fmt::format("collapsed at {:.17g} kPa exactly", largest_kpa)};
  const std::size_t below = tick_of_collapse(std::nextafter(largest_kpa, 0.0), poses);
  if (below != when)
    return {Verdict::failed,
            fmt::format("one ulp above: collapse at tick {}, expected {}", below, when)};
  return {Verdict::passed, fmt::format("holds at {:.17g} kPa, not one ulp above", largest_kpa)};
}

/// beta_i with M_i summed as printed, from ring i + 1 upward.
double largest_printed(const bench::LiteralPaper& paper, const bench::LiteralScene& scene) {
  const auto wall = [](const bench::LiteralRing& r) {
    return r.outer_mm * r.outer_mm - r.inner_mm * r.inner_mm;
  };
  const double scale = std::numbers::pi * scene.ring_height_mm * scene.density_g_cm3 * 1e-6;
  double largest = 0.0;
  const auto& rings = paper.rings();
  for (std::size_t i = 0; i < rings.size(); ++i) {
    double mass = 0.0;
    for (std::size_t j = i + 1; j < rings.size(); ++j) mass += scale * wall(rings[j]);
    largest = std::max(largest, mass / (std::numbers::pi * wall(rings[i])));
  }
  return largest;
}

Outcome threshold_as_printed() {
  bench::LiteralScene scene;
  scene.rings = 60;
  scene.ring_height_mm = 1.0;
  scene.outer_radius_mm = 30.0;
  scene.tool = bench::LiteralEllipse{4.0, 4.0};
  scene.removal_fraction = 0.04;
  const std::vector<Pose> poses = neck(20.0);
  const auto collapses = [&](double threshold) {
    scene.max_stress_kg_per_mm2 = threshold;
    bench::LiteralPaper paper(scene);
    return std::any_of(poses.begin(), poses.end(),
                       [&](const Pose& pose) { return paper.step(pose.position_mm).collapsed; });
  };
  scene.max_stress_kg_per_mm2 = 0.0;
  bench::LiteralPaper paper(scene);
  double largest = 0.0;
  for (const Pose& pose : poses) {
    if (paper.step(pose.position_mm).rings_touched > 0)
      largest = std::max(largest, largest_printed(paper, scene));
  }
  if (collapses(largest)) return {Verdict::failed, "collapsed at the threshold"};
  if (!collapses(std::nextafter(largest, 0.0)))
    return {Verdict::failed, "held above the threshold"};
  return {Verdict::passed, fmt::format("holds at {:.17g} kg/mm^2, not one ulp above", largest)};
}

Outcome threshold_to_the_ulp(Model model) {
  return model == Model::conserving ? threshold_of_the_engine() : threshold_as_printed();
}

Outcome lump_too_heavy(Model model) {
  SceneSpec scene = small_pot();
  scene.stability = StabilitySpec{1.0};  // the lowest ring carries rho g h 59 = 1.1 kPa
  Trial trial(model, scene);
  if (trial.refused()) return trial.done();
  trial.stroke({40, 80, 0}, {40, 81, 0}, 5);
  trial.require(trial.last().collapsed, "did not collapse");
  return trial.done();
}

/// Cuts ring `i` with a rib that touches no other ring, until the stack fails there.
Outcome collapse_at(Model model, std::size_t i) {
  SceneSpec scene = small_pot();
  scene.tool.shape = RibSpec{1.2, 6.0};
  scene.removal.rate_per_s = 200.0;
  scene.stability = StabilitySpec{10.0};
  Trial trial(model, scene);
  const double y = trial.subject().centre_mm(i);
  for (int k = 0; k < 600 && trial.has_no_fault() && !trial.last().collapsed; ++k)
    trial.at({37.0 - 0.05 * k, y + 1e-5 * k, 0});
  trial.require(trial.last().collapsed, "did not collapse");
  if (const Wheel* wheel = trial.subject().wheel(); wheel && trial.has_no_fault()) {
    const Pot pot = wheel->pot();
    const Collapse fallen = pot.collapse.value_or(Collapse{});
    trial.require(pot.collapse.has_value(), "no collapse in the pot");
    trial.require(fallen.failed_ring == i, "another ring failed");
    trial.require(std::abs(fallen.angle_rad) <= 2.0 * std::numbers::pi, "an invalid angle");
    trial.require(std::isfinite(fallen.shift_mm.x + fallen.shift_mm.y + fallen.shift_mm.z),
                  "an invalid shift");
    trial.require(fallen.energy_lost_mj >= 0.0 && fallen.plastic_work_mj >= 0.0 &&
                      fallen.plastic_work_mj <= fallen.energy_lost_mj,
                  fmt::format("{:.3g} mJ lost, {:.3g} mJ spent", fallen.energy_lost_mj,
                              fallen.plastic_work_mj));
    const std::string before = trial.subject().bytes();
    trial.stroke({36, 10, 0}, {20, 20, 0}, 20);
    trial.require(trial.subject().bytes() == before, "a fallen stack was pressed");
    trial.require(trial.last().force_n == glm::dvec3(0.0), "a fallen stack exerts a force");
  }
  return trial.done(fmt::format("ring {} fails", i));
}

Outcome collapse_at_the_base(Model model) { return collapse_at(model, 0); }
Outcome collapse_below_the_top(Model model) { return collapse_at(model, 58); }

/// The top ring carries no load, so it may be cut to almost nothing.
Outcome top_never_fails(Model model) {
  SceneSpec scene = small_pot();
  scene.tool.shape = RibSpec{1.2, 6.0};
  scene.removal.rate_per_s = 200.0;
  scene.stability = StabilitySpec{10.0};
  Trial trial(model, scene);
  const std::size_t top = trial.subject().rings() - 1;
  const double y = trial.subject().centre_mm(top);
  // Downward, so that no ring grows on it.
  for (int k = 0; k < 600; ++k) trial.at({37.0 - 0.05 * k, y - 1e-5 * k, 0});
  trial.require(trial.touched(), "no contact");
  trial.require(!trial.last().collapsed, "collapsed without load");
  return trial.done(fmt::format("top ring of {:.3g} mm", trial.subject().ring(top).outer_mm));
}

constexpr Case kStabilityCases[] = {
    {"threshold_to_the_ulp", "stress at the threshold, and one ulp above",
     "holds; collapses in that tick", "M summed again from the top; 50 digits", Verdict::passed,
     threshold_to_the_ulp},
    {"lump_too_heavy", "a lump that cannot carry its own weight", "refused, or collapsed at once",
     "rho g h (N - 1)", Verdict::failed, lump_too_heavy},
    {"collapse_at_the_base", "the lowest ring is cut until it fails",
     "clay conserved, no energy gained, at rest", "exact rationals, bytes", Verdict::passed,
     collapse_at_the_base},
    {"collapse_below_the_top", "the second ring from the top is cut until it fails",
     "clay conserved, no energy gained, at rest", "exact rationals, bytes", Verdict::failed,
     collapse_below_the_top},
    {"top_never_fails", "the top ring is cut to almost nothing",
     "no collapse, because it carries no load", "M = 0, exact rationals", Verdict::passed,
     top_never_fails},
};

}  // namespace

std::span<const Case> stability_cases() { return kStabilityCases; }

}  // namespace clay::extreme
