// Two tools at once: invalid gaps, gaps wider than the pot, bores narrower than the tool. The paper
// has one tool.

#include "app/bench/extreme/hand.hpp"
#include "app/bench/extreme/overlap_energy.hpp"
#include "app/bench/extreme/trial.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/vec2.hpp>
#include <limits>
#include <vector>

namespace clay::extreme {
namespace {

const Outcome kOneTool{Verdict::not_in_print, "the paper has one tool"};

SceneSpec pinched_pot(double bore_mm) {
  SceneSpec scene = small_pot();
  scene.lump.inner_radius_mm = bore_mm;
  scene.tool.gap_mm = 4.0;
  return scene;
}

/// A stroke up and down the wall with this gap. Requires that the thinnest ring stays above
/// `least_wall_mm`.
Outcome pinched(Model model, const SceneSpec& scene, double d, double gap_mm,
                double least_wall_mm) {
  if (model == Model::literal) return kOneTool;
  Trial trial(model, scene);
  trial.pinch(gap_mm);
  trial.stroke({d, 12, 0}, {d, 48, 0}, 300);
  trial.stroke({d, 48, 0}, {d, 20, 0}, 300);
  trial.require(trial.touched(), "no contact");
  trial.require(trial.largest_force_n() <= 5.0, fmt::format("{:.3g} N", trial.largest_force_n()));
  double wall = 1e9;
  for (std::size_t i = 0; i < trial.subject().rings(); ++i)
    wall = std::min(wall, trial.subject().ring(i).outer_mm - trial.subject().ring(i).inner_mm);
  // One quantum of R^2 and the roundings of two roots.
  trial.require(wall >= least_wall_mm - 1e-11, fmt::format("a wall of {:.6g} mm", wall));
  return trial.done(fmt::format("thinnest ring {:.6g} mm", wall));
}

Outcome denormal_gap(Model model) {
  return pinched(model, pinched_pot(24.0), 27.0, std::numeric_limits<double>::denorm_min(), 0.5);
}
Outcome gap_of_a_picometre(Model model) {
  return pinched(model, pinched_pot(24.0), 27.0, 1e-9, 0.5);
}
Outcome gap_below_the_wall(Model model) {
  SceneSpec scene = pinched_pot(24.0);
  scene.removal.rate_per_s = 1e6;  // e^-1000: the wall reaches the gap in one tick
  return pinched(model, scene, 27.0, 2.0, 2.0);
}
Outcome bore_narrower_than_the_tool(Model model) {
  return pinched(model, pinched_pot(2.0), 20.0, 6.0, 0.5);
}
Outcome pinch_without_bore(Model model) {
  return pinched(model, pinched_pot(0.0), 15.0, 10.0, 0.5);
}
Outcome pinch_on_the_axis(Model model) { return pinched(model, pinched_pot(6.0), 0.0, 3.0, 0.5); }
Outcome pinch_of_a_quantum(Model model) {
  SceneSpec scene = pinched_pot(std::sqrt(mm2_from_quanta(quanta_from_radius(30.0) - 1)));
  return pinched(model, scene, 30.1, 1e-3, 0.0);
}

/// Neither tool touches the wall, of 24 mm inner and 30 mm outer radius.
Outcome nothing_pinched(Model model, const std::vector<glm::dvec2>& distances_and_gaps) {
  if (model == Model::literal) return kOneTool;
  Trial trial(model, pinched_pot(24.0));
  const std::string before = trial.subject().bytes();
  for (const glm::dvec2& at : distances_and_gaps) {
    trial.pinch(at.y);
    trial.stroke({at.x, 12, 0}, {at.x, 48, 0}, 50);
    trial.require(!trial.touched(), fmt::format("contact at d = {}, gap {} mm", at.x, at.y));
    trial.require(trial.largest_force_n() == 0.0, "a force without contact");
    trial.require(trial.subject().bytes() == before, "the clay changed");
  }
  return trial.done();
}

Outcome gap_wider_than_the_pot(Model model) {
  return nothing_pinched(model, {{27, 60}, {27, 200}, {27, 1e3}, {0, 1e3}, {27, 1e6}});
}
Outcome pinch_beside_the_pot(Model model) {
  return nothing_pinched(model, {{50, 1}, {100, 100}, {1e3, 1}, {9e5, 1}});
}
Outcome pinch_in_a_free_bore(Model model) {
  return nothing_pinched(model, {{0, 1}, {5, 3}, {-7, 1}});
}

Outcome invalid_gaps(Model model) {
  if (model == Model::literal) return kOneTool;
  Trial trial(model, pinched_pot(24.0));
  trial.stroke({40, 24, 0}, {36, 28, 0}, 40);
  const std::string before = trial.subject().bytes();
  for (const double gap : {std::nan(""), kInfinity, -kInfinity, -1.0, -1e-300, 1e300, 1.1e6}) {
    trial.pinch(gap);
    const Tick tick = trial.at({27, 28, 0});
    trial.require(tick.refused && tick.force_n == glm::dvec3(0.0),
                  fmt::format("a gap of {} mm was accepted", gap));
    trial.require(trial.subject().bytes() == before, "the clay changed");
  }
  trial.pinch(-0.0);
  trial.require(!trial.at({36, 28, 0}).refused, "-0 is 0: one tool");
  return trial.done();
}

Outcome gap_not_in_the_scene(Model model) {
  if (model == Model::literal) return kOneTool;
  Trial trial(model, small_pot());
  trial.pinch(4.0);
  trial.require(trial.at({27, 28, 0}).refused, "accepted");
  return trial.done();
}

/// Like minus_gradient. The axes of both tools stay outside the wall, because f' is unbounded at a
/// pole in the clay.
Outcome minus_gradient_of_both(Model model) {
  if (model == Model::literal) return kOneTool;
  constexpr double kSoftNPerMm2 = 5e-4, kRingMm = 1.0 / 32.0, kTolerance = 1e-4;
  Hand hand(23);
  double worst = 0.0, largest = 0.0;
  for (int k = 0; k < 60; ++k) {
    SceneSpec scene = pinched_pot(22.0);
    if (k % 2 == 0) scene.tool.shape = EllipseSpec{10.0, 7.0};
    scene.lump.ring_height_mm = kRingMm;
    scene.lump.rings = 1920;
    scene.lump.max_rings = 0;
    scene.force->stiffness_n_per_mm2 = kSoftNPerMm2;
    Trial trial(model, scene);
    const double gap = 0.5 + 7.0 * hand.uniform(), azimuth = 6.28 * hand.uniform();
    const double d = 24.0 + 4.0 * hand.uniform();
    const glm::dvec3 hip(d * std::cos(azimuth), -3.0 + 66.0 * hand.uniform(),
                         d * std::sin(azimuth));
    const OverlapEnergy energy(scene.tool.shape, section_of(trial.subject()), kSoftNPerMm2, gap);
    trial.pinch(gap);
    const glm::dvec3 expected = energy.force_n(hip);
    const double error_n = glm::length(trial.at(hip).force_n - expected);
    worst = std::max(worst, error_n);
    largest = std::max(largest, glm::length(expected));
    if (!(error_n <= kTolerance * 0.02))  // N; the largest is above 0.02 N, see below
      return {Verdict::failed,
              fmt::format("error {:.3g} N at {:.3g} N", error_n, glm::length(expected))};
  }
  if (largest < 0.02) return {Verdict::failed, "too little contact"};
  return {Verdict::passed,
          fmt::format("error at most {:.2g} N, at up to {:.2g} N", worst, largest)};
}

constexpr Case kPinchCases[] = {
    {"denormal_gap", "a gap of the smallest denormal", "clay conserved, no wall below the minimum",
     "exact rationals, interval", Verdict::not_in_print, denormal_gap},
    {"gap_of_a_picometre", "a gap of 1e-9 mm", "clay conserved, no wall below the minimum",
     "exact rationals, interval", Verdict::not_in_print, gap_of_a_picometre},
    {"gap_below_the_wall", "a gap of 2 mm, kappa dt = 1000",
     "clay conserved, no wall below the gap", "exact rationals, interval", Verdict::not_in_print,
     gap_below_the_wall},
    {"bore_narrower_than_the_tool", "the inner tool is beyond the axis", "clay conserved, finite",
     "exact rationals, interval", Verdict::not_in_print, bore_narrower_than_the_tool},
    {"pinch_without_bore", "a pinch in solid clay", "clay conserved, finite",
     "exact rationals, interval", Verdict::not_in_print, pinch_without_bore},
    {"pinch_on_the_axis", "d = 0 with two tools", "clay conserved, finite",
     "exact rationals, interval", Verdict::not_in_print, pinch_on_the_axis},
    {"pinch_of_a_quantum", "a wall of one quantum between two tools", "clay conserved, r < R",
     "exact rationals, invariants", Verdict::not_in_print, pinch_of_a_quantum},
    {"gap_wider_than_the_pot", "gaps of 60 mm to 1 km", "no contact, state unchanged to the bit",
     "bytes", Verdict::not_in_print, gap_wider_than_the_pot},
    {"pinch_beside_the_pot", "both tools outside, to 900 m",
     "no contact, state unchanged to the bit", "bytes", Verdict::not_in_print,
     pinch_beside_the_pot},
    {"pinch_in_a_free_bore", "both tools in the bore, without contact",
     "no contact, state unchanged to the bit", "bytes", Verdict::not_in_print,
     pinch_in_a_free_bore},
    {"invalid_gaps", "NaN, inf, negative, 1e300", "refused, state unchanged to the bit", "bytes",
     Verdict::not_in_print, invalid_gaps},
    {"gap_not_in_the_scene", "a gap although the scene sets none", "refused", "bytes",
     Verdict::not_in_print, gap_not_in_the_scene},
    {"minus_gradient_of_both", "two tools at random poses",
     "force = -grad of both overlap energies to 1e-4 of it", "differences of an integral",
     Verdict::not_in_print, minus_gradient_of_both},
};

}  // namespace

std::span<const Case> pinch_cases() { return kPinchCases; }

}  // namespace clay::extreme
