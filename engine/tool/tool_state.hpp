#pragma once
#include "claystack/engine/tool.hpp"

#include <cstdint>
#include <glm/vec3.hpp>

namespace clay {

inline constexpr double kFarthestMm = 1e6;

/// Effects that alternate, or that are slow, follow the clock of the poses, so that a pot need not
/// store their phase. Poses that are later by whole periods give the same throw.
inline constexpr std::int64_t kClockPeriodUs = 9'000;

/// A valid pose, with the data derived from its predecessors.
struct ToolState {
  glm::dvec3 hip_mm{0.0};
  double dt_s = 0.0;     ///< since the last pose; 0 for the first, at most 0.05
  double phase_s = 0.0;  ///< of the pose, in its period of the clock
  double slow_s = 0.0;   ///< whole thirds of periods that have ended since the last pose
  /// Since the last pose [mm]; zero for the first.
  glm::dvec3 moved_mm{0.0};
  bool upward = true;  ///< direction of clay flow (section 5.1)
  bool trim = false;
  double gap_mm = 0.0;
  bool valid = false;
  bool dt_clamped = false;
};

/// The number of parts in which the clay follows a tick, so that a fast hand gives the same pot as
/// a slow one. Over 0.05 mm the clay changes little; at most 32 keep a tick short when a pose
/// jumps.
[[nodiscard]] int parts_of(const ToolState& tool) noexcept;

/// Section 5.1, "inertia of motion": a hand is slow compared with 1 kHz, so most vertical
/// velocities are measured as zero; the last nonzero one remains valid. Before any, clay flows up.
class ToolTracker {
 public:
  /// Refuses positions that are not finite or beyond 1e6 mm, times that do not advance, and gaps
  /// outside 0 .. widest_gap_mm (valid = false; the state does not change).
  ToolState advance(const Pose& pose, double widest_gap_mm = 0.0) noexcept;
  /// The heights of all poses count from a place that is this much higher than before.
  void raise_origin(double mm) noexcept { last_.position_mm.y -= mm; }

 private:
  Pose last_;
  bool has_last_ = false;
  bool upward_ = true;
};

}  // namespace clay
