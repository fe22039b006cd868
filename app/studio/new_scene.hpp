#pragma once
// Scenes that the window makes for new works. They use the clay rules; a work or a pot that is
// opened keeps its own.

#include "claystack/engine/scene.hpp"

namespace clay::studio {

/// A cylinder of clay of this radius, with settings in proportion to it.
inline constexpr double kLeastClayKg = 0.1, kMostClayKg = 20.0;
[[nodiscard]] SceneSpec lump_of(double clay_kg, double radius_mm);
[[nodiscard]] double lump_height_mm(double clay_kg, double radius_mm);
/// A taller lump cannot carry its own weight.
[[nodiscard]] double tallest_lump_mm() noexcept;

}  // namespace clay::studio
