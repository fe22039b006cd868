#pragma once
// The strokes of a work, thrown again with other rules of the clay.

#include "claystack/core/result.hpp"
#include "claystack/engine/clay.hpp"
#include "claystack/engine/files.hpp"
#include "claystack/engine/scene.hpp"

#include <optional>
#include <vector>

namespace clay::samples {

/// The pots of all nodes, in their order, each thrown from its parent's pot by the recorded poses.
/// The scenes are the recorded ones, but their section `clay` is `clay`. A stroke on a pot that has
/// collapsed leaves it as it is.
Result<std::vector<Pot>> thrown_again(const WorkRecord& work, const std::optional<ClaySpec>& clay);

}  // namespace clay::samples
