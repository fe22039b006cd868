#pragma once
// The state of a wheel, and its tick: one function for each set of stages of a scene.

#include "claystack/engine/wheel.hpp"
#include "engine/collapse/collapse.hpp"
#include "engine/tick/clay_rules.hpp"
#include "engine/tick/front.hpp"
#include "engine/tick/redistribution.hpp"
#include "engine/tick/removal.hpp"
#include "engine/tick/stability.hpp"
#include "engine/tool/tool_state.hpp"

#include <array>
#include <glm/vec3.hpp>
#include <optional>

namespace clay {

struct WheelState;

/// The tick of a scene, and its probe: the force of a tick that moves no clay.
struct Tick {
  StepReport (*step)(WheelState&, const Pose&) noexcept = nullptr;
  StepReport (*probe)(WheelState&, const Pose&) noexcept = nullptr;
};

/// Of a tool that presses or cuts the wall. Its code omits the stages that the scene does not need.
[[nodiscard]] Tick press_tick(unsigned stages) noexcept;
/// Of a needle or a wire.
[[nodiscard]] Tick cut_tick() noexcept;

struct WheelState {
  StepPlan plan;
  ClayStack stack;
  Ledger ledger;
  ToolTracker tracker;
  Rim rim;
  bool touching = false;  // at the last pose
  StabilityWatch watch;
  std::array<ToolRemoval, 2> removals;  // scratch, reserved once; the second is for pinches alone
  // These four serve scenes with clay rules only.
  Motion motion;
  std::array<FlatEnds, 2> ends;  // of the tools of `removals`
  RuleWork work;
  RuleSteps rules;
  std::optional<double> turned_mm;  // height of a pot that stands upside down
  std::size_t loose_rings = 0;      // of its foot, which this tick has cut off
  ThrowSettings settings;
  // Of the pot that was put on the wheel.
  std::optional<ThrowSettings> settings_before;
  std::optional<ToolSpec> shaped_before;  // the tool that left the marks on its walls
  bool thrown = true;                     // false: no pose yet on the pot that was put on the wheel
  std::optional<Failure> failure;
  glm::dvec3 failure_hip_mm{0.0};
  Tick tick;
};

}  // namespace clay
