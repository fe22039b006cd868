#pragma once
// Splits one long recording into strokes, because one undo should remove one stroke although the
// arm is held all the time.

#include "app/history/replay.hpp"
#include "claystack/engine/clay.hpp"
#include "claystack/engine/scene.hpp"
#include "claystack/engine/tool.hpp"

#include <cstddef>
#include <span>
#include <vector>

namespace clay::history {

/// A recording as one or more strokes.
struct Split {
  std::vector<std::size_t> begins;  ///< first pose of each stroke except the first
  std::vector<Pot> pots;            ///< after each stroke
};
[[nodiscard]] Split as_one(Thrown whole);

inline constexpr double kFreeAirS = 0.3;

/// Splits where the tool was in free air for at least kFreeAirS, at a pose after which it moves up
/// or down before it touches: of earlier motion, a stroke depends only on whether the tool last
/// moved up. The split is used only if the strokes, each on the previous pot, give exactly the pot
/// of the whole; otherwise one stroke. `poses`: quantized; `whole`: their result on `before`.
[[nodiscard]] Split split(const SceneSpec& scene, const Pot& before, std::span<const Pose> poses,
                          Thrown whole);

}  // namespace clay::history
