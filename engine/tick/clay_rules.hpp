#pragma once
// The rules of real clay on top of model `conserving` (docs/clay-rules.md): clay that gives way
// moves the wall (shift), becomes height (lift, hoop), or heaves up; a wet finger smears.

#include "claystack/engine/clay.hpp"
#include "claystack/engine/plan.hpp"
#include "engine/tick/band.hpp"
#include "engine/tick/centring.hpp"
#include "engine/tick/finger.hpp"
#include "engine/tick/redistribution.hpp"
#include "engine/tick/relief.hpp"
#include "engine/tick/removal.hpp"
#include "engine/tick/rim_press.hpp"
#include "engine/tick/shift.hpp"
#include "engine/tick/wall_radii.hpp"
#include "engine/tool/tool_state.hpp"

#include <array>
#include <cstddef>
#include <span>
#include <vector>

namespace clay {

inline constexpr unsigned kRuleSets = 64;

/// Advances the tool's mean motion by a tick.
void follow(Motion& motion, const ToolState& tool) noexcept;

/// Data that the stages of one part of a tick pass on. Storage is reserved once.
struct RuleWork {
  WallRadii walls;
  Shift shift;
  PushOver over;                             ///< of a pinch
  std::vector<double> give_sums;             ///< scratch of `bend_wall`
  std::array<Band, 2> bands;                 ///< of each tool
  Shoulders shoulders;                       ///< of the tool
  std::array<std::array<Cone, 2>, 2> cones;  ///< of each tool: at its lower end, at its upper end
  Finger finger;                             ///< of one tool
  RimPress pressed;                          ///< of one tool
  RimLimit rim;                              ///< of a narrow rim
  bool stretches = false;                    ///< one tool makes a solid column longer
  std::array<double, 2> reach_mm{};          ///< of the clay that each tool heaves
  std::size_t lowest = 0, highest = 0;       ///< rings that the flow may change

  void reserve(const Tool& tool, const ClayStack& stack);
};

/// Input of a part of a tick: the plan, the state and the mean motion of the tool, and whether it
/// cuts.
struct RulePress {
  const StepPlan& plan;
  const ToolState& tool;
  const Motion& motion;
  bool trim = false;
};

/// The two stages for a set of rules. Their code omits a rule that is off.
struct RuleSteps {
  /// Computes the distances by which the clay gives way, and the part of them that is a motion of
  /// the wall. Sets the depths of the contacts to the rest. Writes no clay.
  void (*yield)(const RulePress&, const ClayStack&, std::span<ToolRemoval>,
                RuleWork&) noexcept = nullptr;
  /// Moves the clay.
  Flow (*move)(const RulePress&, std::span<const ToolRemoval>, RuleWork&, ClayStack&, Ledger&,
               Rim&) noexcept = nullptr;
};
[[nodiscard]] RuleSteps rule_steps(unsigned rules) noexcept;
/// A sponge: it moves no wall and squeezes nothing out, with any rules.
[[nodiscard]] RuleSteps sponge_steps() noexcept;

}  // namespace clay
