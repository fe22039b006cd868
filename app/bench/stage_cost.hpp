#pragma once
// The cost of a stage of the tick, for `plan` and for `bench`: one stroke in scenes that differ in
// that stage only.

#include "claystack/engine/scene.hpp"
#include "claystack/engine/tool.hpp"

#include <cstddef>
#include <optional>
#include <string_view>
#include <vector>

namespace clay::bench {

/// The scene with the stage included; empty for stages that no setting includes.
std::optional<SceneSpec> with_stage(SceneSpec scene, std::string_view stage);

inline constexpr double kFirmMm = 1.0;  ///< depth of a firm press
inline constexpr int kStrokeTicks = 4000;

/// A stroke from the wheel to the top in kStrokeTicks of 1 ms: up the outside of the scene's lump,
/// or, in mode pinch, up the middle of its wall with that depth on both sides. Negative depths are
/// in free air. Empty for an invalid tool.
std::vector<Pose> stroke_poses(const SceneSpec& scene, double depth_mm);

/// The stroke that is timed: with many rings, on a shorter lump; with very fine rings, only its
/// middle. The time of a tick depends on the rings within reach of the tool, not on their total.
struct TimedStroke {
  SceneSpec scene;
  std::vector<Pose> poses;
};
inline constexpr std::size_t kEnoughRings = 4096;                       ///< of a lump
inline constexpr std::size_t kMostRingsInReach = std::size_t{1} << 16;  ///< of a tick
inline constexpr std::size_t kMostRingVisits = std::size_t{1} << 19;    ///< in a stroke

/// Rings that a tick may touch, and to which its clay may flow.
[[nodiscard]] double rings_in_reach(const SceneSpec& scene);
/// Empty for an invalid tool, and if more than kMostRingsInReach rings are within reach, because
/// even a few ticks would take minutes.
[[nodiscard]] std::optional<TimedStroke> timed_stroke(const SceneSpec& scene, double depth_mm);

/// Mean time [ns] of the ticks of a timed stroke, without making the lump. NaN if there is none,
/// and for an invalid scene.
double stroke_ns(const SceneSpec& scene, double depth_mm = kFirmMm);

/// Median time of a tick in contact [ns], with a stage and without it.
struct StageCost {
  double with_ns = 0.0;
  double without_ns = 0.0;
};

/// Measures the stroke alternately with and without the stage. An included pinch is not used,
/// because a second tool would make a different stroke. Empty for stages that no setting includes,
/// and without a timed stroke.
std::optional<StageCost> cost_of(const SceneSpec& scene, std::string_view stage);

}  // namespace clay::bench
