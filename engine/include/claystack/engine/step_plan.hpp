#pragma once
// What one tick of a scene needs, and nothing more: settings checked once and turned into
// the numbers the stages use.

#include "claystack/engine/rayleigh_kernel.hpp"
#include "claystack/engine/result.hpp"
#include "claystack/engine/scene.hpp"
#include "claystack/engine/tool.hpp"

#include <cstdint>
#include <string>
#include <vector>

namespace clay {

inline constexpr double kStandardGravity = 9.80665;  ///< m/s^2 (ISO 80000-3)
inline constexpr double kPaperRateHz = 1000.0;  ///< the paper's tick, for what it states per tick

/// Stages that a scene may do without. A stage that is out is not compiled into the tick it runs.
enum Stage : unsigned {
  kPaperModel = 1u,
  kForce = 2u,
  kFriction = 4u,
  kStability = 8u,
  kPinch = 16u,
};
inline constexpr unsigned kStageSets = 32;

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
  double turn = 1.0;  ///< +1 counterclockwise seen from above, -1 clockwise
};

struct StabilityPlan {
  double max_stress_kpa = 0.0;
  double kpa_per_ratio = 0.0;  ///< beta_i = this * (quanta above ring i) / (quanta of ring i)
};

/// One line of `claystack plan`.
struct PlanLine {
  std::string stage;
  bool in = true;
  std::string why;
};

struct StepPlan {
  Model model = Model::conserving;
  unsigned stages = 0;  ///< Stage bits
  ToolMode mode = ToolMode::press;
  double gap_mm = 0.0;  ///< of poses without one of their own; 0: these have one tool
  Tool tool;
  RayleighKernel kernel{1.0, 0.0, 1.0, 1};
  std::int64_t inside_share = 0;  ///< alpha in 2^-30
  RemovalPlan removal;
  ForcePlan force;
  StabilityPlan stability;
  double density_g_cm3 = 0.0;
  std::vector<PlanLine> lines;  ///< every stage, in or out, and why

  /// Errors name the setting and its range.
  static Result<StepPlan> build(const SceneSpec& scene);
};

}  // namespace clay
