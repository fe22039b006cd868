#pragma once
#include "claystack/engine/clay_stack.hpp"

#include <cstddef>

namespace clay {

/// The thinnest place of a stepped stack and the ring it starts from.
struct WallMinimum {
  double thickness_mm = 0.0;
  std::size_t ring = 0;
};

/// Least distance through the clay [mm], exact for the steps as they are: from the bore to the
/// outside (across rings as well), through floors and lids along the axis, and across (2R) where
/// there is no bore. O(N) for walls thinner than a few rings.
[[nodiscard]] WallMinimum min_wall(const ClayStack& stack) noexcept;

}  // namespace clay
