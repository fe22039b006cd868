#include "app/bench/stroke_run.hpp"

#include "app/bench/pressing.hpp"
#include "app/bench/timing.hpp"
#include "claystack/engine/wheel.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <glm/geometric.hpp>

namespace clay::bench {
namespace {

constexpr double kLumpMm = 150.0, kOuterMm = 45.0, kInnerMm = 25.0, kStrokeBallMm = 10.0;
constexpr double kSampleS = 0.008;
constexpr double kLowMm = 5.0, kHighMm = 140.0;  // the compared range; the lip may rise
constexpr std::size_t kHeights = 541;            // 0.25 mm apart

/// Rises from 0 to 1 while `time` goes from `begin` to `end`, with zero velocity at both.
double eased(double time, double begin, double end) {
  const double s = std::clamp((time - begin) / (end - begin), 0.0, 1.0);
  return s * s * s * (10.0 - 15.0 * s + 6.0 * s * s);
}

/// Radius at a height, with its square interpolated between the centres of rings.
template <class Squared>
double radius_at(double y_mm, double ring_height_mm, std::size_t rings, Squared squared) {
  const double at = std::clamp(y_mm / ring_height_mm - 0.5, 0.0, static_cast<double>(rings - 1));
  const auto below = std::min(static_cast<std::size_t>(at), rings - 2);
  const double part = at - static_cast<double>(below);
  return std::sqrt((1.0 - part) * squared(below) + part * squared(below + 1));
}

template <class Outer2, class Inner2>
void sample_profile(Outcome& outcome, double ring_height_mm, std::size_t rings, Outer2 outer2,
                    Inner2 inner2) {
  for (std::size_t k = 0; k < kHeights; ++k) {
    const double y = kLowMm + (kHighMm - kLowMm) * static_cast<double>(k) / (kHeights - 1);
    outcome.outer_mm.push_back(radius_at(y, ring_height_mm, rings, outer2));
    outcome.inner_mm.push_back(radius_at(y, ring_height_mm, rings, inner2));
  }
}

Pose pose_at(int tick, int rate_hz) {
  Pose pose;
  pose.time_us = std::int64_t{1'000'000} * tick / rate_hz;
  pose.position_mm = stroke_mm(static_cast<double>(tick) / rate_hz);
  return pose;
}

std::vector<Pose> poses_at(int rate_hz) {
  std::vector<Pose> poses;
  for (int tick = 0; tick <= ticks_of(rate_hz); ++tick) poses.push_back(pose_at(tick, rate_hz));
  return poses;
}

/// The first ring of the paper is centred at y = 0, that of the engine at h/2.
glm::dvec3 literal_hip(glm::dvec3 hip_mm, const LiteralScene& scene) {
  hip_mm.y -= 0.5 * scene.ring_height_mm;
  return hip_mm;
}

LiteralScene literal_scene(const Fineness& fineness) {
  return literal_of(stroke_scene(fineness, Variant::paper), LiteralWriting::eased);
}

}  // namespace

int ticks_of(int rate_hz) { return static_cast<int>(std::lround(kStrokeS * rate_hz)); }

glm::dvec3 stroke_mm(double t) {
  const double in = eased(t, 0.1, 0.7) - eased(t, 2.0, 2.3);
  // Rises from the start, because the paper's clay has no direction before any vertical motion.
  const double up = eased(t, 0.0, 2.0);
  return {kOuterMm + kStrokeBallMm + 2.0 - 8.0 * in, 50.0 + 50.0 * up, 0.0};
}

SceneSpec stroke_scene(const Fineness& fineness, Variant variant) {
  SceneSpec scene;
  const bool paper = variant != Variant::conserving && variant != Variant::clay_rules;
  scene.model = paper ? Model::paper : Model::conserving;
  if (variant == Variant::clay_rules) scene.clay = ClaySpec{};
  scene.lump.rings = fineness.rings;
  scene.lump.ring_height_mm = kLumpMm / static_cast<double>(fineness.rings);
  scene.lump.outer_radius_mm = kOuterMm;
  scene.lump.inner_radius_mm = kInnerMm;
  scene.tool.shape = SphereSpec{kStrokeBallMm};
  scene.flow.reach_mm = fineness.reach_mm;
  // The paper's K and k are per ring and per tick: those of 200 rings at 1 kHz are used for all
  // runs.
  scene.force->paper_stiffness_n_per_mm = scene.force->stiffness_n_per_mm2 * kLumpMm / 200.0;
  scene.removal.paper_fraction = scene.removal.rate_per_s / kPaperRateHz;
  if (variant == Variant::paper_scaled) {
    scene.force->paper_stiffness_n_per_mm.reset();
    scene.removal.paper_fraction = -std::expm1(-scene.removal.rate_per_s / fineness.rate_hz);
  }
  scene.stability = StabilitySpec{1e6};
  return scene;
}

namespace {

Outcome play_engine(const Fineness& fineness, Variant variant) {
  Outcome outcome;
  Wheel wheel = Wheel::build(stroke_scene(fineness, variant)).value();
  const int every = static_cast<int>(std::lround(kSampleS * fineness.rate_hz));
  const double initial = static_cast<double>(wheel.ledger().initial);
  for (int tick = 0; tick <= ticks_of(fineness.rate_hz); ++tick) {
    const StepReport report = wheel.step(pose_at(tick, fineness.rate_hz));
    if (tick % every == 0) outcome.force_n.push_back(report.force_n());
    const auto error = static_cast<double>(wheel.ledger().volume_error(wheel.stack().volume()));
    outcome.volume_error = std::max(outcome.volume_error, std::abs(error) / initial);
  }
  // The running volume is checked against a recount of the rings.
  const auto counted = static_cast<double>(wheel.ledger().volume_error(wheel.stack().recount()));
  outcome.volume_error = std::max(outcome.volume_error, std::abs(counted) / initial);
  const auto rings = wheel.stack().rings();
  const auto mm2 = [](Quanta quanta) { return static_cast<double>(quanta) * kMm2PerQuantum; };
  sample_profile(
      outcome, wheel.stack().ring_height_mm(), rings.size(),
      [&](std::size_t i) { return mm2(rings[i].outer2); },
      [&](std::size_t i) { return mm2(rings[i].inner2); });
  outcome.collapsed = wheel.collapsed();
  return outcome;
}

Outcome play_literal(const Fineness& fineness) {
  Outcome outcome;
  const LiteralScene scene = literal_scene(fineness);
  LiteralPaper paper(scene);
  const int every = static_cast<int>(std::lround(kSampleS * fineness.rate_hz));
  const double initial = paper.volume();
  for (int tick = 0; tick <= ticks_of(fineness.rate_hz); ++tick) {
    const LiteralReport report =
        paper.step(literal_hip(stroke_mm(static_cast<double>(tick) / fineness.rate_hz), scene));
    outcome.collapsed = outcome.collapsed || report.collapsed || report.undefined;
    if (tick % every == 0) outcome.force_n.push_back(report.force_n);
    const double error = std::abs(paper.volume() - initial) / initial;
    // Not max: a NaN must be kept and shown.
    if (!(error <= outcome.volume_error)) outcome.volume_error = error;
  }
  const auto& rings = paper.rings();
  sample_profile(
      outcome, scene.ring_height_mm, rings.size(),
      [&](std::size_t i) { return rings[i].outer_mm * rings[i].outer_mm; },
      [&](std::size_t i) { return rings[i].inner_mm * rings[i].inner_mm; });
  return outcome;
}

double time_engine(const Fineness& fineness, Variant variant) {
  Wheel wheel = Wheel::build(stroke_scene(fineness, variant)).value();
  const auto poses = poses_at(fineness.rate_hz);
  return work_seconds_of([&] {
    for (const Pose& pose : poses) wheel.step(pose);
  });
}

double time_literal(const Fineness& fineness) {
  const LiteralScene scene = literal_scene(fineness);
  LiteralPaper paper(scene);
  const auto poses = poses_at(fineness.rate_hz);
  return work_seconds_of([&] {
    for (const Pose& pose : poses) paper.step(literal_hip(pose.position_mm, scene));
  });
}

}  // namespace

Outcome play(const Fineness& fineness, Variant variant) {
  return variant == Variant::literal ? play_literal(fineness) : play_engine(fineness, variant);
}

double time_of(const Fineness& fineness, Variant variant) {
  return variant == Variant::literal ? time_literal(fineness) : time_engine(fineness, variant);
}

Outcome extrapolated(const Outcome& fine, const Outcome& half) {
  Outcome limit = fine;
  const auto toward = [](auto& values, const auto& coarse) {
    for (std::size_t k = 0; k < values.size(); ++k) values[k] += values[k] - coarse[k];
  };
  toward(limit.outer_mm, half.outer_mm);
  toward(limit.inner_mm, half.inner_mm);
  toward(limit.force_n, half.force_n);
  return limit;
}

Deviation deviation(const Outcome& outcome, const Outcome& reference) {
  Deviation worst;
  double sum_mm = 0.0, squares = 0.0;
  for (const auto surface : {&Outcome::outer_mm, &Outcome::inner_mm})
    for (std::size_t k = 0; k < kHeights; ++k) {
      const double difference = std::abs((outcome.*surface)[k] - (reference.*surface)[k]);
      // Not max: a NaN must be kept and shown.
      if (std::isnan(difference) || difference > worst.profile_max_mm)
        worst.profile_max_mm = difference;
      sum_mm += difference;
    }
  worst.profile_mean_mm = sum_mm / (2.0 * kHeights);
  const std::size_t count = std::min(outcome.force_n.size(), reference.force_n.size());
  for (std::size_t k = 0; k < count; ++k) {
    const double difference = glm::distance(outcome.force_n[k], reference.force_n[k]);
    if (std::isnan(difference) || difference > worst.force_max_n) worst.force_max_n = difference;
    squares += difference * difference;
  }
  worst.force_rms_n = std::sqrt(squares / static_cast<double>(count));
  return worst;
}

}  // namespace clay::bench
