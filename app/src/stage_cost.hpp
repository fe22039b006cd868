#pragma once
#include "claystack/engine/scene.hpp"

#include <optional>
#include <string_view>

namespace clay::app {

/// Median time of a tick in contact [ns], with a stage and without it.
struct StageCost {
  double with_ns = 0.0;
  double without_ns = 0.0;
};

/// Measured now, on this machine, on this scene: a stroke up the outside of the lump (or
/// up its wall, in mode pinch), with the stage put in and left out by turns. A pinch put in is not
/// made use of: a second tool is another stroke, not another stage. Nothing for stages that can't
/// be put in by a setting.
std::optional<StageCost> cost_of(const SceneSpec& scene, std::string_view stage);

}  // namespace clay::app
