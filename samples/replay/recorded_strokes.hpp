#pragma once
// The strokes of a work, thrown again with other rules of the clay.

#include "claystack/core/result.hpp"
#include "claystack/engine/clay.hpp"
#include "claystack/engine/files.hpp"
#include "claystack/engine/scene.hpp"

#include <cstddef>
#include <optional>
#include <vector>

namespace clay::samples {

/// The pots of all nodes, in their order, each thrown from its parent's pot by the recorded poses.
/// The scenes are the recorded ones, but their section `clay` is `clay`. A stroke on a pot that has
/// collapsed leaves it as it is. With rings of the recorded height over `finer`.
Result<std::vector<Pot>> thrown_again(const WorkRecord& work, const std::optional<ClaySpec>& clay,
                                      int finer = 1);

/// Whether the hand cut clay off in a stroke: a cutter leaves its own shape.
[[nodiscard]] bool cuts(const WorkRecord& work, std::size_t node);

/// Mean distance of the outer and of the inner surfaces of two pots, every 0.5 mm of height up to
/// the lower rim [mm].
[[nodiscard]] double mean_difference_mm(const ClayStack& one, const ClayStack& other);

}  // namespace clay::samples
