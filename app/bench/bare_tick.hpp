#pragma once
// A tick composed by hand from the engine's stages, without force, friction, stability and pinch:
// the reference for the cost of skipped stages.

#include "claystack/engine/clay.hpp"
#include "claystack/engine/plan.hpp"
#include "claystack/engine/wheel.hpp"
#include "engine/tick/redistribution.hpp"
#include "engine/tick/removal.hpp"
#include "engine/tool/tool_state.hpp"

#include <vector>

namespace clay::bench {

class BareWheel {
 public:
  /// For a scene that Wheel::build accepts; ignores its settings for the four stages.
  explicit BareWheel(const SceneSpec& scene);
  StepReport step(const Pose& pose) noexcept;  ///< the engine's report; reporting is not a stage
  [[nodiscard]] const ClayStack& stack() const noexcept { return stack_; }

 private:
  void press(const ToolState& tool, StepReport& report) noexcept;
  StepPlan plan_;
  ClayStack stack_;
  Ledger ledger_;
  ToolTracker tracker_;
  Rim rim_;
  bool touching_ = false;              // in the last pose
  std::vector<ToolRemoval> removals_;  // one element
};

/// Duration [s] of the stroke of `stroke_ns`.
[[nodiscard]] double bare_stroke_s(const SceneSpec& scene, double depth_mm);

}  // namespace clay::bench
