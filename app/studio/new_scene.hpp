#pragma once
// Scenes that the window makes for new works. They use the clay rules; a work that is opened keeps
// its own scene.

#include "claystack/engine/clay.hpp"
#include "claystack/engine/scene.hpp"

#include <string>

namespace clay::studio {

/// A cylinder of clay of this radius, with settings in proportion to it.
inline constexpr double kLeastClayKg = 0.1, kMostClayKg = 20.0;
[[nodiscard]] SceneSpec lump_of(double clay_kg, double radius_mm);
[[nodiscard]] double lump_height_mm(double clay_kg, double radius_mm);

/// A scene with settings in proportion to a pot that has no scene. A pot of the paper's model keeps
/// it.
[[nodiscard]] SceneSpec scene_for(const Pot& pot, const std::string& name);

}  // namespace clay::studio
