#pragma once
#include "claystack/engine/tool.hpp"
#include "claystack/engine/wheel.hpp"

#include <span>
#include <vector>

namespace clay::history {

/// The result of a stroke's poses.
struct Thrown {
  Pot pot;
  std::vector<bool> touching;  ///< for each pose: whether the tool was in the clay
};

/// Plays the poses of a stroke again, from its beginning.
[[nodiscard]] Thrown replay(Wheel wheel, std::span<const Pose> poses);

}  // namespace clay::history
