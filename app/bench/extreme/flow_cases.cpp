// Distribution of displaced clay: kernels, shares and growth at the limits of their ranges.

#include "app/bench/extreme/trial.hpp"

#include <fmt/format.h>

#include <limits>

namespace clay::extreme {
namespace {

void press_the_middle(Trial& trial) {
  trial.stroke({40, 22, 0}, {36, 26, 0}, 40);
  trial.stroke({36, 26, 0}, {35, 34, 0}, 80);
  trial.stroke({35, 34, 0}, {35, 26, 0}, 80);
  trial.require(trial.touched(), "no contact");
}

Outcome with_flow(Model model, double sigma_mm, double reach_mm) {
  SceneSpec scene = small_pot();
  scene.flow.sigma_mm = sigma_mm;
  scene.flow.reach_mm = reach_mm;
  Trial trial(model, scene);
  press_the_middle(trial);
  return trial.done();
}

Outcome sigma_0(Model model) { return with_flow(model, 0.0, 12.0); }
Outcome sigma_underflows(Model model) { return with_flow(model, 0.02, 12.0); }
Outcome sigma_1e9(Model model) { return with_flow(model, 1e9, 12.0); }
Outcome reach_0(Model model) { return with_flow(model, 4.0, 0.0); }
Outcome reach_beyond_the_pot(Model model) { return with_flow(model, 400.0, 5'000.0); }

Outcome sigma_infinite(Model model) {
  SceneSpec scene = small_pot();
  scene.flow.sigma_mm = kInfinity;
  Trial trial(model, scene);
  press_the_middle(trial);
  trial.require(trial.refused(), "accepted");
  return trial.done();
}

/// Q_p(x) -> x / sigma^2: ring j gets j / (1 + 2 + .. + L1), a limit that needs no exp.
Outcome sigma_1e9_is_linear(Model model) {
  SceneSpec scene = small_pot();
  scene.flow.sigma_mm = 1e9;
  scene.tool.shape = RibSpec{10.0, 6.0};
  Trial trial(model, scene);
  // The tool rests with its end in the middle of a ring, where the kernel starts.
  trial.stroke({45, 30.4, 0}, {45, 30.5, 0}, 2);
  trial.at({34, 30.5, 0});
  if (!trial.has_no_fault()) return trial.done();
  Exact gained = 0;
  for (std::size_t j = 1; j <= 12; ++j)
    gained += square_of(trial.subject().ring(35 + j).outer_mm) - 900;
  for (std::size_t j = 1; j <= 12; ++j) {
    const Exact share = (square_of(trial.subject().ring(35 + j).outer_mm) - 900) / gained;
    // The table has 40 fractional bits; the radius is the root of a count, to half an ulp.
    const double error = abs(Exact(share - Exact(j, 78))).convert_to<double>();
    trial.require(error < 0x1p-39, fmt::format("share {} has an error of {:.2g}", j, error));
  }
  return trial.done();
}

/// All clay goes to the nearest ring, the limit of the kernel for sigma -> 0.
Outcome sigma_0_is_the_limit(Model model) {
  SceneSpec scene = small_pot();
  scene.flow.sigma_mm = 0.0;
  scene.tool.shape = RibSpec{10.0, 6.0};
  Trial trial(model, scene);
  trial.stroke({45, 29.9, 0}, {45, 30.1, 0}, 2);
  trial.at({34, 30.2, 0});
  // The rib ends at 35.2: the middle of ring 34 is level with it; ring 35 contains its upper end.
  int gained = 0;
  for (std::size_t i = 0; i < trial.subject().rings(); ++i)
    if (trial.subject().ring(i).outer_mm > 30.0) ++gained;
  trial.require(gained == 1, fmt::format("{} rings received clay", gained));
  return trial.done();
}

Outcome narrow_bore(Model model, double inside_share) {
  SceneSpec scene = small_pot();
  scene.lump.inner_radius_mm = 1.0;
  scene.flow.inside_share = inside_share;
  Trial trial(model, scene);
  press_the_middle(trial);
  return trial.done();
}

Outcome alpha_1(Model model) { return narrow_bore(model, 1.0); }
Outcome alpha_0(Model model) { return narrow_bore(model, 0.0); }

/// Opens a bore from above, then presses clay down past its floor.
Outcome one_ring_without_bore(Model model) {
  Trial trial(model, small_pot());
  trial.stroke({0, 70, 0}, {0, 45, 0}, 100);
  trial.stroke({45, 45, 0}, {37, 44, 0}, 20);
  trial.stroke({37, 44, 0}, {34, 36, 0}, 100);
  trial.require(trial.touched(), "no contact");
  return trial.done();
}

Outcome never_moved(Model model) {
  Trial trial(model, small_pot());
  for (int k = 0; k < 50; ++k) trial.at({36, 30, 0});
  trial.require(trial.touched(), "no contact");
  return trial.done("clay moved up");
}

/// A hand at rest keeps its direction: after an upward motion no clay goes below the tool, after a
/// downward motion none above it.
Outcome hand_at_rest(Model model) {
  Trial trial(model, small_pot());
  const auto rest = [&](const glm::dvec3& from, const glm::dvec3& to, bool above) {
    trial.stroke(from, to, 10);
    const double edge = to.y + (above ? 8.0 : -10.0);  // the printed range starts a ring lower
    const auto gained = [&] {
      double sum = 0.0;
      for (std::size_t i = 0; i < trial.subject().rings(); ++i)
        if ((trial.subject().centre_mm(i) > edge) == above) sum += trial.subject().ring(i).outer_mm;
      return sum;
    };
    const double before = gained();
    for (int k = 0; k < 20; ++k) trial.at(to);
    trial.require(gained() == before, "a hand at rest reversed the clay");
  };
  rest({40, 28, 0}, {36, 30, 0}, false);
  rest({36, 31, 0}, {35, 29, 0}, true);
  trial.require(trial.touched(), "no contact");
  return trial.done();
}

/// Cuts the top to the thinnest rings; then more clay rises than they can hold.
Outcome growth_onto_an_empty_top(Model model) {
  SceneSpec scene = small_pot();
  scene.tool.shape = RibSpec{12.0, 40.0};
  scene.removal.min_wall_mm = kMinRadiusMm;
  scene.removal.rate_per_s = 1e6;
  scene.removal.paper_fraction = 1.0 - 1e-9;
  scene.lump.max_rings = 5'000;
  Trial trial(model, scene);
  trial.stroke({20, 60, 0}, {20, 59.9, 0}, 20, true);
  trial.stroke({200, 54, 0}, {200, 54.5, 0}, 2);
  trial.stroke({20, 54.6, 0}, {20, 54.7, 0}, 200);
  trial.require(trial.last().ring_limit, "the limit is not reported");
  trial.require(trial.subject().rings() == 5'000, "not grown to the limit");
  return trial.done(fmt::format("{} rings", trial.subject().rings()));
}

Outcome rim_upward(Model model) {
  Trial trial(model, small_pot());
  trial.stroke({40, 50, 0}, {36, 52, 0}, 40);
  trial.stroke({36, 52, 0}, {34, 62, 0}, 200);
  return trial.done(fmt::format("{} rings", trial.subject().rings()));
}

Outcome base_downward(Model model) {
  Trial trial(model, small_pot());
  trial.stroke({40, 12, 0}, {36, 8, 0}, 40);
  trial.stroke({36, 8, 0}, {34, -2, 0}, 200);
  return trial.done();
}

Outcome all_clay_cut_away(Model model) {
  SceneSpec scene = small_pot();
  scene.tool.shape = RibSpec{300.0, 200.0};
  scene.removal.min_wall_mm = kMinRadiusMm;
  scene.removal.rate_per_s = 1e6;
  scene.removal.paper_fraction = 1.0 - 1e-9;
  Trial trial(model, scene);
  trial.stroke({40, 29, 0}, {40, 31, 0}, 200, true);
  trial.stroke({0, 31, 0}, {0, 29, 0}, 200, true);
  trial.require(trial.touched(), "no contact");
  return trial.done();
}

/// At max_rings, rising clay stays in the crown and is counted.
Outcome no_room_above(Model model) {
  if (model == Model::literal) return {Verdict::not_in_print, "the paper states no limit of N"};
  SceneSpec scene = small_pot();
  scene.lump.max_rings = 60;
  Trial trial(model, scene);
  trial.stroke({40, 50, 0}, {36, 52, 0}, 40);
  trial.stroke({36, 52, 0}, {30, 58, 0}, 2'000);
  trial.require(trial.last().ring_limit, "the limit is not reported");
  trial.require(trial.subject().rings() == 60, "grown beyond the limit");
  return trial.done();
}

Outcome rate_far_beyond_the_tick(Model model) {
  SceneSpec scene = small_pot();
  scene.removal.rate_per_s = 1e6;  // times 1 ms: e^-1000
  if (model == Model::literal) scene.removal.paper_fraction = 1.0;
  Trial trial(model, scene);
  press_the_middle(trial);
  return trial.done();
}

Outcome fraction_above_1(Model model) {
  SceneSpec scene = small_pot();
  scene.removal.paper_fraction = 1.5;
  Trial trial(model, scene);
  trial.stroke({40, 25, 0}, {36, 30, 0}, 50);
  trial.require(trial.refused(), "accepted");
  return trial.done();
}

constexpr Case kFlowCases[] = {
    {"sigma_0", "sigma = 0", "clay conserved, no 0/0", "exact rationals", Verdict::failed, sigma_0},
    {"sigma_0_is_the_limit", "sigma = 0, one tick", "the nearest ring receives all", "the limit",
     Verdict::failed, sigma_0_is_the_limit},
    {"sigma_underflows", "h / sigma = 50: every weight underflows", "clay conserved, no 0/0",
     "exact rationals", Verdict::failed, sigma_underflows},
    {"sigma_1e9", "sigma = 1e9 mm", "clay conserved", "exact rationals", Verdict::passed,
     sigma_1e9},
    {"sigma_infinite", "sigma = inf", "refused: no file could hold it", "invariants",
     Verdict::failed, sigma_infinite},
    {"sigma_1e9_is_linear", "sigma = 1e9 mm, one tick", "shares as 1 : 2 : .. : L1",
     "rationals of the limit", Verdict::passed, sigma_1e9_is_linear},
    {"reach_0", "L1 = 0", "clay conserved, as height", "exact rationals", Verdict::failed, reach_0},
    {"reach_beyond_the_pot", "L1 = 5000 on 60 rings", "clay conserved", "exact rationals",
     Verdict::failed, reach_beyond_the_pot},
    {"alpha_1", "all clay to the inside, bore of 1 mm", "clay conserved, r >= 0, the rest outside",
     "exact rationals, invariants", Verdict::failed, alpha_1},
    {"alpha_0", "no clay to the inside, bore of 1 mm", "clay conserved", "exact rationals",
     Verdict::passed, alpha_0},
    {"one_ring_without_bore", "clay pressed down across the floor of a bore",
     "clay conserved, r >= 0 ring by ring", "exact rationals, invariants", Verdict::failed,
     one_ring_without_bore},
    {"never_moved", "zero velocity from the first sample", "clay conserved, in a default direction",
     "exact rationals", Verdict::failed, never_moved},
    {"hand_at_rest", "zero velocity after an upward and after a downward motion",
     "the last direction is kept", "rings on the other side, to the bit", Verdict::passed,
     hand_at_rest},
    {"growth_onto_an_empty_top", "excess onto an almost empty top ring",
     "the tick ends; clay conserved", "exact rationals, count of rings", Verdict::failed,
     growth_onto_an_empty_top},
    {"rim_upward", "a stroke up over the rim", "clay conserved", "exact rationals", Verdict::failed,
     rim_upward},
    {"base_downward", "a stroke down onto the wheel head", "clay conserved", "exact rationals",
     Verdict::passed, base_downward},
    {"all_clay_cut_away", "a tool larger than the pot, k = 1", "the tick ends; clay accounted for",
     "exact rationals, count of rings", Verdict::failed, all_clay_cut_away},
    {"no_room_above", "growth with max_rings reached", "clay conserved and the limit reported",
     "exact rationals", Verdict::not_in_print, no_room_above},
    {"rate_far_beyond_the_tick", "kappa dt = 1000; k = 1", "clay conserved, r < R",
     "exact rationals, invariants", Verdict::failed, rate_far_beyond_the_tick},
    {"fraction_above_1", "k = 1.5", "refused: it would invert walls", "invariants", Verdict::failed,
     fraction_above_1},
};

}  // namespace

std::span<const Case> flow_cases() { return kFlowCases; }

}  // namespace clay::extreme
