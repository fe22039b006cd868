// The force: direction, magnitude, and the energy whose gradient it is.

#include "app/bench/extreme/hand.hpp"
#include "app/bench/extreme/overlap_energy.hpp"
#include "app/bench/extreme/trial.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

namespace clay::extreme {
namespace {

/// Soft enough to stay below 5 N. With h = 1, K of a ring is the same in both models.
constexpr double kSoftNPerMm = 5e-4;

SceneSpec soft_pot(const ToolShapeSpec& shape, double bore_mm) {
  SceneSpec scene = small_pot();
  scene.tool.shape = shape;
  scene.lump.inner_radius_mm = bore_mm;
  scene.force->stiffness_n_per_mm2 = kSoftNPerMm;
  scene.force->paper_stiffness_n_per_mm = kSoftNPerMm;
  return scene;
}

/// A place near the wall, outside or inside, at any azimuth.
glm::dvec3 place_near_wall(Hand& hand, const ToolShapeSpec& shape, bool outside) {
  const double f = half_profile(shape, 0).convert_to<double>();
  const double depth = 3.0 * hand.uniform() - 0.5, azimuth = 6.28 * hand.uniform();
  const double d = outside ? 30.0 + f - depth : std::max(0.5, 18.0 - f + depth);
  // Includes both ends of the stack, where the force has a vertical part. The flat ends of a rib,
  // which have no f', stay inside the stack.
  const bool rib = std::holds_alternative<RibSpec>(shape);
  const double y = rib ? 10.0 + 40.0 * hand.uniform() : -3.0 + 66.0 * hand.uniform();
  return {d * std::cos(azimuth), y, d * std::sin(azimuth)};
}

/// The first tick of a scene has dt = 0 and moves no clay in the engine; in both models the force
/// is that of the rings before it. The rings are thin, so that their sum approximates the integral;
/// its error is of second order in h.
Outcome minus_gradient(Model model) {
  constexpr double kRingMm = 1.0 / 16.0, kTolerance = 1e-4;  // of the largest force
  Hand hand(17);
  double worst = 0.0, largest = 0.0;
  for (const ToolShapeSpec& shape :
       {ToolShapeSpec{SphereSpec{8}}, ToolShapeSpec{EllipseSpec{12, 5}},
        ToolShapeSpec{RibSpec{14, 6}}})
    for (const bool outside : {true, false})
      for (int k = 0; k < 25; ++k) {
        SceneSpec scene = soft_pot(shape, 18.0);
        scene.lump.ring_height_mm = kRingMm;
        scene.lump.rings = 960;
        scene.lump.max_rings = 0;
        scene.force->paper_stiffness_n_per_mm = kSoftNPerMm * kRingMm;
        Trial trial(model, scene);
        const OverlapEnergy energy(shape, section_of(trial.subject()), kSoftNPerMm, outside);
        const glm::dvec3 hip = place_near_wall(hand, shape, outside),
                         expected = energy.force_n(hip);
        const double error_n = glm::length(trial.at(hip).force_n - expected);
        worst = std::max(worst, error_n);
        largest = std::max(largest, glm::length(expected));
        if (!(error_n <= kTolerance * 0.01))  // N; the largest is above 0.01 N, see below
          return {Verdict::failed,
                  fmt::format("error {:.3g} N at {:.3g} N, {}", error_n, glm::length(expected),
                              outside ? "outside" : "inside")};
      }
  if (largest < 0.01) return {Verdict::failed, "too little contact"};
  return {Verdict::passed,
          fmt::format("error at most {:.2g} N, at up to {:.2g} N", worst, largest)};
}

Outcome azimuths(Model model) {
  for (const bool outside : {true, false})
    for (int k = 0; k < 64; ++k) {
      const double azimuth = 2.0 * 3.141592653589793 * k / 64.0 + 0.01;
      const double d = outside ? 36.0 : 12.0;
      Trial trial(model, soft_pot(SphereSpec{8}, 18.0));
      const glm::dvec3 out(std::cos(azimuth), 0.0, std::sin(azimuth));
      const glm::dvec3 force = trial.at(d * out + glm::dvec3(0, 30.2, 0)).force_n;
      const double radial = glm::dot(force, out);
      if (!(outside ? radial > 0.0 : radial < 0.0))
        return {Verdict::failed,
                fmt::format("pulled into the clay {} at {:.0f} degrees: {:+.3g} N",
                            outside ? "outside" : "inside", azimuth * 57.29578, radial)};
      const double across = glm::dot(force, glm::dvec3(-out.z, 0.0, out.x));
      if (std::abs(across) > 1e-12) return {Verdict::failed, "sideways without friction"};
    }
  return {Verdict::passed, "64 azimuths, both sides"};
}

Outcome hip_on_the_axis(Model model) {
  SceneSpec scene = small_pot();
  scene.force->friction = 0.3;
  Trial trial(model, scene);
  trial.at({0, 67, 0});
  for (int k = 0; k < 40; ++k) {
    const Tick tick = trial.at({0, 66.9 - 0.05 * k, 0});
    trial.require(tick.contact, "no contact");
    trial.require(tick.force_n.x == 0.0 && tick.force_n.z == 0.0, "sideways on the axis");
    trial.require(tick.force_n.y > 0.0, "not pushed up");
  }
  return trial.done();
}

double force_at_height(Model model, double h) {
  SceneSpec scene = soft_pot(SphereSpec{8}, 0.0);
  scene.lump.rings = static_cast<std::size_t>(std::lround(60.0 / h));
  scene.lump.ring_height_mm = h;
  scene.lump.max_rings = 0;
  Trial trial(model, scene);
  return glm::length(trial.at({35.0, 30.0 + 0.25 * h, 0}).force_n);
}

Outcome force_as_rings_thin(Model model) {
  const double coarse = force_at_height(model, 1.0), fine = force_at_height(model, 1.0 / 500.0);
  const bool same = std::abs(fine / coarse - 1.0) < 0.02;
  return {same ? Verdict::passed : Verdict::failed,
          fmt::format("{:.3g} N, {:.3g} N at h/500", coarse, fine)};
}

Outcome stiffness_1e6(Model model) {
  SceneSpec scene = small_pot();
  scene.force->stiffness_n_per_mm2 = 1e3;
  scene.force->paper_stiffness_n_per_mm = 1e3;  // 10^6 N/m
  Trial trial(model, scene);
  trial.stroke({40, 24, 0}, {34, 28, 3}, 60);
  trial.require(trial.largest_force_n() > 4.999, "too little contact");
  trial.require(trial.largest_force_n() <= 5.0, fmt::format("{:.3g} N", trial.largest_force_n()));
  const glm::dvec3 out = glm::normalize(glm::dvec3(34, 0, 3));
  trial.require(glm::dot(trial.last().force_n, out) > 0.0, "pulled into the clay");
  return trial.done();
}

Outcome friction_2(Model model) {
  SceneSpec scene = small_pot();
  scene.force->stiffness_n_per_mm2 = 10.0;
  scene.force->paper_stiffness_n_per_mm = 10.0;
  scene.force->friction = 2.0;
  Trial trial(model, scene);
  trial.stroke({40, 24, 0}, {34, 28, 0}, 60);
  trial.require(trial.largest_force_n() > 4.999, "too little contact");
  trial.require(trial.largest_force_n() <= 5.0, fmt::format("{:.3g} N", trial.largest_force_n()));
  return trial.done();
}

/// A half-profile that rises by 4 mm within 1e-308 mm: its slope overflows.
Outcome tool_with_a_step(Model model) {
  if (model == Model::literal)
    return {Verdict::not_in_print, "the paper assumes that f_h is continuous"};
  SceneSpec scene = small_pot();
  scene.tool.shape = SampledSpec{{-8.0, 0.0, 1e-308, 8.0}, {1.0, 2.0, 6.0, 7.0}};
  Trial trial(model, scene);
  trial.stroke({40, 20, 0}, {34, 25.5, 0}, 50);
  for (int k = 0; k < 50; ++k) trial.at({34, 25.5 + 0.5 * k, 0});
  trial.require(trial.touched(), "no contact");
  trial.require(trial.largest_force_n() <= 5.0, fmt::format("{:.3g} N", trial.largest_force_n()));
  return trial.done();
}

constexpr Case kForceCases[] = {
    {"minus_gradient", "sphere, ellipse and rib at random poses, both sides",
     "force = -grad of the overlap energy to 1e-4 of it", "differences of an integral",
     Verdict::failed, minus_gradient},
    {"azimuths", "64 azimuths, both sides", "outward outside, inward inside", "sign",
     Verdict::failed, azimuths},
    {"hip_on_the_axis", "d = 0", "finite, no sideways part", "invariants", Verdict::failed,
     hip_on_the_axis},
    {"force_as_rings_thin", "h and h/500", "force changes by less than 2 %", "interval",
     Verdict::failed, force_as_rings_thin},
    {"stiffness_1e6", "10^6 N/m per ring", "at most 5 N, outward", "interval", Verdict::failed,
     stiffness_1e6},
    {"friction_2", "mu = 2", "at most 5 N in total", "interval", Verdict::failed, friction_2},
    {"tool_with_a_step", "a profile whose slope overflows", "finite, at most 5 N, clay conserved",
     "interval, exact rationals", Verdict::not_in_print, tool_with_a_step},
};

}  // namespace

std::span<const Case> force_cases() { return kForceCases; }

}  // namespace clay::extreme
