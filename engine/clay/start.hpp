#pragma once
#include "claystack/core/result.hpp"
#include "claystack/engine/clay.hpp"
#include "claystack/engine/scene.hpp"

namespace clay {

/// Whether a scene can go on with a pot. Errors name the setting, what the pot asks of it, and what
/// was found.
Result<void> check_start(const SceneSpec& scene, const Pot& start);

}  // namespace clay
