#include "stage_cost.hpp"

#include "claystack/engine/tool.hpp"
#include "claystack/engine/wheel.hpp"

#include <algorithm>
#include <chrono>
#include <vector>

namespace clay::app {
namespace {

constexpr int kRounds = 9;  // odd: the median is one of them
constexpr int kTicks = 4000;
constexpr double kDepthMm = 1.0;

/// The scene with the stage in; nothing where no setting puts it in.
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
    scene.tool.gap_mm = kDepthMm;
  } else {
    return std::nullopt;
  }
  return scene;
}

/// One stroke up the outside, or up the middle of the wall where the scene pinches, at the depth of
/// a firm hand.
double stroke_ns(const SceneSpec& scene, const Tool& tool) {
  auto wheel = Wheel::build(scene);
  if (!wheel) return 0.0;
  using Clock = std::chrono::steady_clock;
  const double height = wheel->stack().height_mm();
  const double outer = scene.lump.outer_radius_mm, inner = scene.lump.inner_radius_mm;
  const bool pinch = scene.tool.mode == ToolMode::pinch;
  const double x = pinch ? 0.5 * (outer + inner) : outer + tool.radius(0.0) - kDepthMm;
  const double gap = pinch ? std::max(0.0, outer - inner - 2.0 * kDepthMm) : 0.0;
  const auto start = Clock::now();
  for (int k = 0; k < kTicks; ++k)
    wheel->step({1000 * (k + 1), {x, height * k / kTicks, 0.0}, false, gap});
  return std::chrono::duration<double, std::nano>(Clock::now() - start).count() / kTicks;
}

double median(std::vector<double> values) {
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

}  // namespace

std::optional<StageCost> cost_of(const SceneSpec& scene, std::string_view stage) {
  const auto with = with_stage(scene, stage);
  const auto tool = Tool::build(scene.tool.shape);
  if (!with || !tool) return std::nullopt;
  std::vector<double> in, out;
  for (int round = 0; round < kRounds; ++round) {
    out.push_back(stroke_ns(scene, *tool));
    in.push_back(stroke_ns(*with, *tool));
  }
  return StageCost{median(in), median(out)};
}

}  // namespace clay::app
