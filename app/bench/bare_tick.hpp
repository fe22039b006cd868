#pragma once
// A tick written by hand of the engine's stages, as if force, friction, stability and pinch had
// never been thought of: what leaving them out has to be as fast as.

#include "claystack/engine/clay.hpp"
#include "claystack/engine/tick.hpp"
#include "engine/tick/redistribution.hpp"
#include "engine/tick/removal.hpp"
#include "engine/tool/tool_state.hpp"

#include <vector>

namespace clay::bench {

class BareWheel {
 public:
  /// Of a scene that Wheel::build takes; whatever it asks for beside the four is left out.
  explicit BareWheel(const SceneSpec& scene);
  void step(const Pose& pose) noexcept;
  [[nodiscard]] const ClayStack& stack() const noexcept { return stack_; }

 private:
  void press(const ToolState& tool) noexcept;
  StepPlan plan_;
  ClayStack stack_;
  Ledger ledger_;
  ToolTracker tracker_;
  Rim rim_;
  bool touching_ = false;           // at the last pose
  std::vector<ToolRemoval> bites_;  // one
};

/// Seconds of the stroke of `cli::stroke_ns`.
[[nodiscard]] double bare_stroke_s(const SceneSpec& scene, double depth_mm);

}  // namespace clay::bench
