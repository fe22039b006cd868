#pragma once
#include "claystack/core/result.hpp"
#include "claystack/engine/clay.hpp"
#include "claystack/engine/scene.hpp"

namespace clay {

/// Checks whether a scene can continue a pot. Errors name the setting, the value that the pot
/// requires and the value found.
Result<void> check_start(const SceneSpec& scene, const Pot& start);

}  // namespace clay
