#pragma once
// What a stage of the tick costs, for `plan` and for the measurements of `bench`: one stroke, in
// scenes that differ in that stage alone.

#include "claystack/engine/scene.hpp"
#include "claystack/engine/tool.hpp"

#include <cstddef>
#include <optional>
#include <string_view>
#include <vector>

namespace clay::cli {

/// The scene with the stage in; nothing for stages that no setting puts in.
std::optional<SceneSpec> with_stage(SceneSpec scene, std::string_view stage);

inline constexpr double kFirmMm = 1.0;  ///< depth of a firm hand
inline constexpr int kStrokeTicks = 4000;

/// A stroke from the wheel to the top in kStrokeTicks of 1 ms: up the outside of the scene's lump,
/// or, in mode pinch, up the middle of its wall and so deep from both sides. Below 0 mm deep it is
/// in the air. Nothing for a tool that cannot be built.
std::vector<Pose> stroke_poses(const SceneSpec& scene, double depth_mm);

/// What is played to time a stroke: all of it; where rings are many, on a shorter lump; and its
/// middle, where they are so fine that all of it would take too long. The time of a tick depends on
/// the rings within reach of the tool, not on how many there are.
struct TimedStroke {
  SceneSpec scene;
  std::vector<Pose> poses;
};
inline constexpr std::size_t kEnoughRings = 4096;                       ///< of a lump
inline constexpr std::size_t kMostRingsInReach = std::size_t{1} << 16;  ///< of a tick
inline constexpr std::size_t kMostRingVisits = std::size_t{1} << 19;    ///< in a stroke

/// Rings that a tick may touch, and that its clay may flow to.
[[nodiscard]] double rings_in_reach(const SceneSpec& scene);
/// Nothing for a tool that cannot be built, and where more than kMostRingsInReach are within reach:
/// a stroke of a few ticks would take minutes.
[[nodiscard]] std::optional<TimedStroke> timed_stroke(const SceneSpec& scene, double depth_mm);

/// Mean time [ns] of the ticks of a timed stroke; to make the lump does not count. NaN where there
/// is none, and for a scene that cannot be built.
double stroke_ns(const SceneSpec& scene, double depth_mm = kFirmMm);

/// Median time of a tick in contact [ns], with a stage and without it.
struct StageCost {
  double with_ns = 0.0;
  double without_ns = 0.0;
};

/// Measured now, on this machine, on this scene: the stroke with the stage put in and left out by
/// turns. A pinch put in is not made use of: a second tool is another stroke, not another stage.
/// Nothing for stages that can't be put in by a setting, and where there is no timed stroke.
std::optional<StageCost> cost_of(const SceneSpec& scene, std::string_view stage);

}  // namespace clay::cli
