#pragma once
#include "claystack/engine/clay_stack.hpp"

#include <cstddef>

namespace clay {

/// The thinnest place of a stepped stack and the ring it starts from.
struct WallMinimum {
  double thickness_mm = 0.0;
  std::size_t ring = 0;
};

/// Least thickness [mm] of a stepped stack, exact for the steps as they are: from the bore to the
/// outside (across rings as well), through floors, lids and solid pots along the axis, and across
/// (2R) where there is no bore. Flanges that stick out are not looked at. O(N) for walls of a few
/// rings.
[[nodiscard]] WallMinimum min_wall(const ClayStack& stack) noexcept;

/// [mm]; 0 without rings.
[[nodiscard]] double largest_radius_mm(const ClayStack& stack) noexcept;

}  // namespace clay
