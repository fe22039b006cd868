#pragma once
// One long recording into strokes: an arm is held on and on, and one undo should take back one
// stroke of it.

#include "app/history/replay.hpp"
#include "claystack/engine/clay.hpp"
#include "claystack/engine/scene.hpp"
#include "claystack/engine/tool.hpp"

#include <cstddef>
#include <span>
#include <vector>

namespace clay::history {

/// A recording, thrown, in one or more strokes.
struct Split {
  std::vector<std::size_t> begins;  ///< pose at which each stroke but the first begins
  std::vector<Pot> pots;            ///< after each stroke
};
[[nodiscard]] Split as_one(Thrown whole);

inline constexpr double kFreeAirS = 0.3;

/// Cut where the tool was in free air for kFreeAirS at least, at a pose after which it moves up or
/// down before it touches: a stroke remembers of its past only whether the tool last moved up. Kept
/// only if the strokes, each on the pot before, give the very pot that the whole gives; else one.
/// `poses`: quantised; `whole`: what they make of `before`.
[[nodiscard]] Split split(const SceneSpec& scene, const Pot& before, std::span<const Pose> poses,
                          Thrown whole);

}  // namespace clay::history
