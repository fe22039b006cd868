#pragma once
// The scene in which a pot is thrown on: the tool and the clay that it remembers, or usual ones.

#include "claystack/engine/clay.hpp"
#include "claystack/engine/scene.hpp"

#include <string>

namespace clay::history {

/// The usual length of a finger, for `ClaySpec::finger_mm`.
inline constexpr double kFingerMm = 90.0;

/// The clay of a new work: the six rules and all options.
[[nodiscard]] ClaySpec usual_clay();
/// The usual settings, for a lump or a pot of this height.
[[nodiscard]] SceneSpec usual_scene(double height_mm);

/// For strokes on a pot: `Pot::thrown_with`, or the usual settings for its size. The scene
/// gets a name.
[[nodiscard]] SceneSpec scene_for(const Pot& pot, const std::string& name);

}  // namespace clay::history
