#include "app/bench/convergence_experiments.hpp"

#include "claystack/engine/wheel.hpp"

#include <glm/geometric.hpp>
#include <glm/vec2.hpp>

#include <algorithm>
#include <cmath>

namespace clay::bench {
namespace {

/// A hand that moves on straight lines with minimum jerk (Flash and Hogan, J. Neurosci. 5(7) 1985).
class Hand {
 public:
  explicit Hand(glm::dvec3 start_mm) : poses_{{0, start_mm, false}} {}
  Hand& to(glm::dvec3 goal_mm, double mean_mm_s) {
    const glm::dvec3 from = poses_.back().position_mm;
    const int ticks = std::max(1, static_cast<int>(glm::distance(from, goal_mm) / mean_mm_s * 1e3));
    for (int k = 1; k <= ticks; ++k) {
      const double u = static_cast<double>(k) / ticks;
      add(from + (goal_mm - from) * (u * u * u * (10.0 + u * (6.0 * u - 15.0))));
    }
    return *this;
  }
  std::vector<Pose> take() { return std::move(poses_); }

 private:
  void add(glm::dvec3 at) { poses_.push_back({poses_.back().time_us + 1000, at, false}); }
  std::vector<Pose> poses_;
};

SceneSpec lump(double outer_mm, double inner_mm, double height_mm, ToolShapeSpec tool) {
  SceneSpec scene;
  scene.lump.rings = static_cast<std::size_t>(height_mm / 0.2);
  scene.lump.ring_height_mm = 0.2;
  scene.lump.outer_radius_mm = outer_mm;
  scene.lump.inner_radius_mm = inner_mm;
  scene.lump.max_rings = 4 * scene.lump.rings;
  scene.tool.shape = tool;
  scene.flow = {5.0, 15.0, 0.3};
  return scene;
}

double upper_edge(const ClayStack& stack, std::size_t ring) {
  return ring + 1 == stack.size() ? stack.height_mm()
                                  : stack.ring_height_mm() * static_cast<double>(ring + 1);
}

/// The stepped section of the stack on one side of the axis.
std::vector<glm::dvec2> outline(const ClayStack& stack) {
  std::vector<glm::dvec2> line;
  const auto rings = stack.rings();
  const auto low = [&](std::size_t i) { return stack.ring_height_mm() * static_cast<double>(i); };
  for (std::size_t i = 0; i < rings.size(); ++i) {
    line.emplace_back(rings[i].outer_mm(), low(i));
    line.emplace_back(rings[i].outer_mm(), upper_edge(stack, i));
  }
  for (std::size_t i = rings.size(); i-- > 0;) {
    line.emplace_back(rings[i].inner_mm(), upper_edge(stack, i));
    line.emplace_back(rings[i].inner_mm(), low(i));
  }
  return line;
}

double distance2(glm::dvec2 p, glm::dvec2 a, glm::dvec2 b) {
  const glm::dvec2 edge = b - a;
  const double length2 = glm::dot(edge, edge);
  const double u = length2 > 0.0 ? std::clamp(glm::dot(p - a, edge) / length2, 0.0, 1.0) : 0.0;
  const glm::dvec2 offset = p - (a + u * edge);
  return glm::dot(offset, offset);
}

double farthest2(const std::vector<glm::dvec2>& line, const std::vector<glm::dvec2>& from) {
  double worst = 0.0;
  for (const glm::dvec2& p : line) {
    double best = HUGE_VAL;
    for (std::size_t k = 0; k + 1 < from.size() && best > worst; ++k)
      best = std::min(best, distance2(p, from[k], from[k + 1]));
    worst = std::max(worst, best);
  }
  return worst;
}

}  // namespace

std::vector<Experiment> convergence_experiments() {
  return {
      {"rib pressed to a wall", lump(40, 30, 60, RibSpec{20, 6}),
       Hand({50, 30, 0}).to({42, 30, 0}, 20).take()},
      {"sphere pushed up a lump", lump(40, 0, 60, SphereSpec{10}),
       Hand({60, 15, 0}).to({46, 15, 0}, 40).to({45, 40, 0}, 40).to({60, 45, 0}, 40).take()},
      {"opening", lump(45, 0, 60, SphereSpec{10}),
       Hand({0, 80, 0}).to({0, 20, 0}, 40).to({15, 20, 0}, 20).to({18, 90, 0}, 40).take()},
      {"wall pulled past its rim", lump(20, 14, 60, EllipseSpec{12, 7}),
       Hand({40, 10, 0}).to({26, 10, 0}, 100).to({25, 90, 0}, 190).take()},
  };
}

SceneSpec refined(SceneSpec scene, std::size_t factor) {
  scene.lump.max_rings = factor * max_rings_of(scene.lump);
  scene.lump.rings *= factor;
  scene.lump.ring_height_mm /= static_cast<double>(factor);
  return scene;
}

std::vector<Pose> resampled(const std::vector<Pose>& poses, std::int64_t period_us) {
  std::vector<Pose> result;
  std::size_t k = 0;
  for (auto t = poses.front().time_us; t <= poses.back().time_us; t += period_us) {
    while (k + 2 < poses.size() && poses[k + 1].time_us <= t) ++k;
    const Pose &a = poses[k], &b = poses[k + 1];
    const double u =
        static_cast<double>(t - a.time_us) / static_cast<double>(b.time_us - a.time_us);
    Pose pose = u < 1.0 ? a : b;
    pose.time_us = t;
    pose.position_mm = a.position_mm + u * (b.position_mm - a.position_mm);
    result.push_back(pose);
  }
  return result;
}

Played played(const SceneSpec& scene, const std::vector<Pose>& poses) {
  Wheel wheel = Wheel::build(scene).value();
  Played run;
  for (const Pose& pose : poses) {
    run.time_us.push_back(pose.time_us);
    run.force_n.push_back(wheel.step(pose).force_n());
  }
  run.stack = wheel.stack();
  return run;
}

ProfileDifference profile_difference(const ClayStack& stack, const ClayStack& reference) {
  constexpr int kLevels = 20'000;
  const auto ring_at = [](const ClayStack& s, double y) {
    return s.rings()[std::min(s.size() - 1, static_cast<std::size_t>(y / s.ring_height_mm()))];
  };
  const double height = std::min(stack.height_mm(), reference.height_mm());
  double sum = 0.0;
  for (int k = 0; k < kLevels; ++k) {
    const double y = height * (k + 0.5) / kLevels;
    const Ring a = ring_at(stack, y), b = ring_at(reference, y);
    const double out = a.outer_mm() - b.outer_mm(), in = a.inner_mm() - b.inner_mm();
    sum += 0.5 * (out * out + in * in);
  }
  const auto one = outline(stack), other = outline(reference);
  return {std::sqrt(sum / kLevels),
          std::sqrt(std::max(farthest2(one, other), farthest2(other, one))),
          stack.height_mm() - reference.height_mm()};
}

ForceDifference force_difference(const Played& run, const Played& reference) {
  ForceDifference result;
  for (const glm::dvec3& force : reference.force_n)
    result.largest_n = std::max(result.largest_n, glm::length(force));
  std::size_t j = 0, common = 0;
  double sum = 0.0, largest = 0.0;
  for (std::size_t i = 0; i < run.time_us.size(); ++i) {
    while (j < reference.time_us.size() && reference.time_us[j] < run.time_us[i]) ++j;
    if (j == reference.time_us.size()) break;
    if (reference.time_us[j] != run.time_us[i]) continue;
    const double difference = glm::distance(run.force_n[i], reference.force_n[j]);
    sum += difference * difference;
    largest = std::max(largest, difference);
    ++common;
  }
  result.rms_percent = 100.0 * std::sqrt(sum / static_cast<double>(common)) / result.largest_n;
  result.most_percent = 100.0 * largest / result.largest_n;
  return result;
}

RestingRib resting_rib(double ring_height_mm, double rate_hz) {
  RestingRib rib;
  rib.scene = lump(40, 30, 60, RibSpec{20, 6});
  rib.scene.lump.rings = static_cast<std::size_t>(std::lround(60.0 / ring_height_mm));
  rib.scene.lump.ring_height_mm = ring_height_mm;
  rib.scene.lump.max_rings = 2 * rib.scene.lump.rings;
  rib.jump_mm = 4.0;
  for (int k = 0; k <= static_cast<int>(0.1 * rate_hz); ++k)
    rib.poses.push_back({std::lround(1e6 * k / rate_hz), {46.0 - rib.jump_mm, 30.0, 0.0}, false});
  return rib;
}

double RestingRib::wall_mm(double t_s) const {
  const double wall = scene.lump.outer_radius_mm - scene.lump.inner_radius_mm;
  const double knee = scene.removal.yield_depth_mm, behind = wall - jump_mm;
  const double rate = scene.removal.rate_per_s,
               since = t_s - std::log(wall / (behind + knee)) / rate;
  if (since < 0.0) return wall * std::exp(-rate * t_s);
  const double left = std::exp(-rate * behind * since / knee);
  return behind + behind * knee * left / (behind + knee * (1.0 - left));
}

double RestingRib::force_n(double t_s) const {
  const double wall = scene.lump.outer_radius_mm - scene.lump.inner_radius_mm;
  const double depth = jump_mm - (wall - wall_mm(t_s));
  return scene.force->stiffness_n_per_mm2 * std::get<RibSpec>(scene.tool.shape).height_mm * depth;
}

}  // namespace clay::bench
