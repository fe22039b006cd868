#include "app/bench/stage_cost.hpp"

#include "app/bench/thread_clock.hpp"
#include "app/history/pot_scene.hpp"
#include "claystack/engine/tool.hpp"
#include "claystack/engine/wheel.hpp"

#include <algorithm>
#include <limits>
#include <utility>
#include <vector>

namespace clay::bench {
namespace {

constexpr int kRounds = 9;  // odd, so that the median is a sample

double median(std::vector<double> values) {
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

/// Adds a clay rule to the scene, or the rule alone if the scene has none.
std::optional<SceneSpec> with_rule(SceneSpec scene, std::string_view rule) {
  if (!scene.clay) scene.clay = ClaySpec{false, false, false, false, false, false, 120.0, 0.0};
  ClaySpec& clay = *scene.clay;
  if (rule == "lift")
    clay.lift = true;
  else if (rule == "shift")
    clay.shift = true;
  else if (rule == "rim")
    clay.rim = true;
  else if (rule == "hoop")
    clay.shift = clay.hoop = true;
  else if (rule == "heave")
    clay.heave = true;
  else if (rule == "smear")
    clay.smear = true;
  else if (rule == "finger" && scene.tool.mode == ToolMode::press) {
    clay.heave = true;
    clay.finger_mm = history::kFingerMm;
  } else if (rule == "thin wall")
    clay.shift = clay.thin_wall_yields = true;
  else if (rule == "pressed rim" &&
           (scene.tool.mode == ToolMode::press || scene.tool.mode == ToolMode::trim))
    clay.heave = clay.rim_sinks = true;
  else if (rule == "narrow rim" &&
           (scene.tool.mode == ToolMode::press || scene.tool.mode == ToolMode::pinch))
    clay.narrow_rim_closes = true;
  else if (rule == "lifted wall" &&
           (scene.tool.mode == ToolMode::press || scene.tool.mode == ToolMode::pinch))
    clay.lift = clay.lifted_wall_stretches = true;
  else if (rule == "pushed wall" && scene.tool.mode == ToolMode::press)
    clay.shift = clay.pushed_wall_bends = true;
  else if (rule == "pressed lump" && scene.tool.mode == ToolMode::press)
    clay.heave = clay.pressed_lump_stretches = true;
  else if (rule == "thin rim" &&
           (scene.tool.mode == ToolMode::press || scene.tool.mode == ToolMode::pinch))
    clay.rim = clay.thin_rim_rises = true;
  else
    return std::nullopt;
  return scene;
}

}  // namespace

std::optional<SceneSpec> with_stage(SceneSpec scene, std::string_view stage) {
  if (stage == "inner surface") {
    scene.lump.inner_radius_mm = 0.5 * scene.lump.outer_radius_mm;
  } else if (stage == "force") {
    scene.force = ForceSpec{};
  } else if (stage == "friction") {
    if (!scene.force) scene.force = ForceSpec{};
    scene.force->friction = 0.3;
  } else if (stage == "stability") {
    scene.stability = StabilitySpec{1e6};
  } else if (stage == "pinch") {
    scene.tool.gap_mm = kFirmMm;
  } else if (scene.model != Model::paper) {
    return with_rule(std::move(scene), stage);
  } else {
    return std::nullopt;
  }
  return scene;
}

std::vector<Pose> stroke_poses(const SceneSpec& scene, double depth_mm) {
  const auto tool = Tool::build(scene.tool.shape);
  if (!tool) return {};
  const double height = static_cast<double>(scene.lump.rings) * scene.lump.ring_height_mm;
  const double outer = scene.lump.outer_radius_mm, inner = scene.lump.inner_radius_mm;
  const bool pinch = scene.tool.mode == ToolMode::pinch;
  const double x = pinch ? 0.5 * (outer + inner) : outer + tool->radius(0.0) - depth_mm;
  std::vector<Pose> poses(kStrokeTicks);
  for (int k = 0; k < kStrokeTicks; ++k) {
    Pose& pose = poses[static_cast<std::size_t>(k)];
    pose.time_us = 1000 * (k + 1);
    pose.position_mm = {x, height * k / kStrokeTicks, 0.0};
    if (pinch) pose.gap_mm = std::max(0.0, outer - inner - 2.0 * depth_mm);
  }
  return poses;
}

double rings_in_reach(const SceneSpec& scene) {
  const auto tool = Tool::build(scene.tool.shape);
  const double touched_mm = tool ? tool->high() - tool->low() : 0.0;
  const double rings = (touched_mm + scene.flow.reach_mm) / scene.lump.ring_height_mm + 1.0;
  return std::min(rings, static_cast<double>(max_rings_of(scene.lump)));
}

std::optional<TimedStroke> timed_stroke(const SceneSpec& scene, double depth_mm) {
  const double reach = rings_in_reach(scene);
  if (reach > kMostRingsInReach) return std::nullopt;
  TimedStroke timed{scene, {}};
  LumpSpec& lump = timed.scene.lump;
  const std::size_t enough = std::max(kEnoughRings, static_cast<std::size_t>(2.0 * reach));
  if (lump.rings > enough) {
    lump.rings = enough;
    lump.max_rings = 0;
  }
  timed.poses = stroke_poses(timed.scene, depth_mm);
  if (timed.poses.empty()) return std::nullopt;
  const auto ticks = static_cast<std::ptrdiff_t>(static_cast<double>(kMostRingVisits) / reach);
  if (ticks < kStrokeTicks) {
    const auto first = timed.poses.begin() + (kStrokeTicks - ticks) / 2;
    timed.poses = std::vector<Pose>(first, first + ticks);
  }
  return timed;
}

double stroke_ns(const SceneSpec& scene, double depth_mm) {
  const auto timed = timed_stroke(scene, depth_mm);
  if (!timed) return std::numeric_limits<double>::quiet_NaN();
  auto wheel = Wheel::build(timed->scene);
  if (!wheel) return std::numeric_limits<double>::quiet_NaN();
  const double start = thread_seconds();
  for (const Pose& pose : timed->poses) wheel->step(pose);
  return 1e9 * (thread_seconds() - start) / static_cast<double>(timed->poses.size());
}

std::optional<StageCost> cost_of(const SceneSpec& scene, std::string_view stage) {
  const auto with = with_stage(scene, stage);
  if (!with || !timed_stroke(scene, kFirmMm)) return std::nullopt;
  std::vector<double> in, out;
  for (int round = 0; round < kRounds; ++round) {
    out.push_back(stroke_ns(scene));
    in.push_back(stroke_ns(*with));
  }
  return StageCost{median(in), median(out)};
}

}  // namespace clay::bench
