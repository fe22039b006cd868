#pragma once
// The data of one tick of a scene, and nothing more: settings checked once and converted to the
// numbers that the stages use.

#include "claystack/core/result.hpp"
#include "claystack/engine/scene.hpp"
#include "claystack/engine/tool.hpp"

#include <cstddef>
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

namespace clay {

inline constexpr double kPaperRateHz = 1000.0;  ///< the paper's rate, for its values per tick

/// Stages that a scene can omit. An omitted stage is not compiled into the tick that runs.
enum Stage : unsigned {
  kPaperModel = 1u,
  kForce = 2u,
  kFriction = 4u,
  kStability = 8u,
  kPinch = 16u,
  kRules = 32u,  ///< some clay rule
};

/// Clay rules that a scene can omit, like the stages above.
enum Rule : unsigned {
  kLift = 1u,
  kShift = 2u,
  kRim = 4u,
  kHoop = 8u,
  kHeave = 16u,
  kSmear = 32u,
};

class RayleighKernel;

struct RemovalPlan {
  double rate_per_s = 0.0;  ///< conserving: kappa
  double yield_depth_mm = 0.0;
  double min_wall_mm = 0.0;
  double paper_fraction = 0.0;  ///< paper: k
};

struct ForcePlan {
  double stiffness_n_per_mm = 0.0;  ///< of one ring: K' h, or the paper's K
  double limit_n = 5.0;
  double friction = 0.0;
  double turn = 1.0;         ///< +1 counterclockwise seen from above, -1 clockwise
  double per_ring_mm = 1.0;  ///< 1 / h
};

struct StabilityPlan {
  double max_stress_kpa = 0.0;
  double kpa_per_ratio = 0.0;  ///< beta_i = this * (quanta above ring i) / (quanta of ring i)
  bool gaps_fail = false;      ///< a ring that does not touch the one above fails: with clay rules
};

struct RulesPlan {
  unsigned rules = 0;  ///< Rule bits
  /// The solid rings that no tool opens: the lowest, or below the bore if the tool trims the foot.
  std::size_t floor_rings = 0;
  double surface_per_s = 0.0;           ///< speed of a surface of radius 1 under a tool
  double finger_mm = 0.0;               ///< above a tool in a bore; 0: none
  double finger_behind = 0.0;           ///< as ClaySpec's [radii of the tool]
  bool thin_wall_yields = false;        ///< as ClaySpec's
  bool rim_sinks = false;               ///< as ClaySpec's, for a tool that presses or trims
  bool narrow_rim_closes = false;       ///< as ClaySpec's, for a tool that moves clay
  bool lifted_wall_stretches = false;   ///< as ClaySpec's, for two tools that lift
  bool pushed_wall_bends = false;       ///< as ClaySpec's, with shift
  bool sponge_follows = false;          ///< as ClaySpec's, for a sponge
  bool pressed_lump_stretches = false;  ///< as ClaySpec's, for a tool that moves clay
  bool thin_rim_rises = false;          ///< as ClaySpec's, for a tool that moves clay
  double heave_slope = 0.0;             ///< as ClaySpec's
};

/// One line of `claystack plan`.
struct PlanLine {
  std::string stage;
  bool in = true;
  std::string why;
};

/// Whether a tool of this mode cuts the pot at one height and does nothing else.
[[nodiscard]] constexpr bool cuts_level(ToolMode mode) noexcept {
  return mode == ToolMode::needle || mode == ToolMode::wire;
}

struct StepPlan {
  Model model = Model::conserving;
  unsigned stages = 0;  ///< Stage bits
  ToolMode mode = ToolMode::press;
  double gap_mm = 0.0;  ///< of poses that have none; 0: these have one tool
  Tool tool;
  std::shared_ptr<const RayleighKernel> kernel;  ///< private to the engine
  std::int64_t inside_share = 0;                 ///< alpha in 2^-30
  RemovalPlan removal;
  ForcePlan force;
  StabilityPlan stability;
  RulesPlan clay;
  double density_g_cm3 = 0.0;
  std::vector<PlanLine> lines;  ///< every stage, in or out, and why

  /// Errors name the setting and its range.
  static Result<StepPlan> build(const SceneSpec& scene);
};

}  // namespace clay
