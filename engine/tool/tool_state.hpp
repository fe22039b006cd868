#pragma once
#include "claystack/engine/tool.hpp"

#include <glm/vec3.hpp>

namespace clay {

inline constexpr double kFarthestMm = 1e6;

/// A valid pose, with the data derived from its predecessors.
struct ToolState {
  static constexpr double kPeriodS = 0.009;  ///< of `phase_s`
  glm::dvec3 hip_mm{0.0};
  double dt_s = 0.0;  ///< since the last pose; 0 for the first, at most 0.05
  /// Whole periods of 3 ms that have ended since then, counted on the clock of the poses: effects
  /// that are slow take place once in a period, with no state that a pot would have to keep.
  double slow_s = 0.0;
  double phase_s = 0.0;  ///< of the pose, on its clock, in a period of 9 ms
  /// Since the last pose [mm]; zero for the first.
  glm::dvec3 moved_mm{0.0};
  bool upward = true;  ///< direction of clay flow (section 5.1)
  bool trim = false;
  double gap_mm = 0.0;
  bool valid = false;
  bool dt_clamped = false;
};

/// Section 5.1, "inertia of motion": a hand is slow compared with 1 kHz, so most vertical
/// velocities are measured as zero; the last nonzero one remains valid. Before any, clay flows up.
class ToolTracker {
 public:
  /// Refuses positions that are not finite or beyond 1e6 mm, times that do not advance, and gaps
  /// outside 0 .. widest_gap_mm (valid = false; the state does not change).
  ToolState advance(const Pose& pose, double widest_gap_mm = 0.0) noexcept;

 private:
  Pose last_;
  bool has_last_ = false;
  bool upward_ = true;
};

}  // namespace clay
