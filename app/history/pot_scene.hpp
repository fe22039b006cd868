#pragma once
// The scene for further strokes on a pot: the tool and the clay that the pot remembers, or usual
// ones.

#include "claystack/engine/clay.hpp"
#include "claystack/engine/scene.hpp"

#include <string>

namespace clay::history {

/// The usual length of a finger, for `ClaySpec::finger_mm`.
inline constexpr double kFingerMm = 90.0;
/// For `ClaySpec::finger_behind`: a lump that is opened at its bottom has a wide mouth.
inline constexpr double kFingerBehind = 0.5;

/// For `ClaySpec::heave_slope`: a lump that is opened or pressed widens little, and grows instead.
inline constexpr double kHeaveSlope = 0.2;

/// These rules with all options, as in new works.
[[nodiscard]] inline ClaySpec with_all_options(ClaySpec clay) {
  clay.finger_mm = kFingerMm;
  clay.finger_behind = kFingerBehind;
  clay.heave_slope = kHeaveSlope;
  clay.thin_wall_yields = clay.rim_sinks = true;
  clay.narrow_rim_closes = clay.lifted_wall_stretches = clay.pushed_wall_bends = true;
  clay.sponge_follows = clay.pressed_lump_stretches = clay.thin_rim_rises = true;
  return clay;
}
/// The clay of a new work: the six rules and all options.
[[nodiscard]] inline ClaySpec usual_clay() {
  constexpr double kFloorMm = 5.0;  // usual for a pot that is not trimmed on its foot
  return with_all_options({.floor_mm = kFloorMm});
}
/// The usual settings, for a lump or a pot of this height.
[[nodiscard]] SceneSpec usual_scene(double height_mm);

/// For strokes on a pot: `Pot::thrown_with`, or the usual settings for its size. The scene
/// gets a name.
[[nodiscard]] SceneSpec scene_for(const Pot& pot, const std::string& name);

}  // namespace clay::history
