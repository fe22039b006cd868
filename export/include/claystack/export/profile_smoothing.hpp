#pragma once
// From the steps of a stack to the walls that a potter sees, without losing clay.

#include "claystack/engine/clay_stack.hpp"
#include "claystack/engine/result.hpp"
#include "claystack/export/profile.hpp"

namespace clay::solid {

enum class Smoothing {
  none,  ///< the steps as they are
  fair,  ///< R^2 and r^2 mollified by one and the same kernel
};

/// The profile of a stack with fair walls. R^2 and r^2 are convolved with a box one ring wide:
/// the walls pass through the middle of every ring, and chords join the middles, so that between
/// them the wall R - r is a mean of two rings' own. Foot, lip and floors stay corners. Middles
/// that lie within `tolerance_mm` / 2 of the line without them are left out (Douglas and Peucker,
/// Cartographica 10(2) 1973). What chords and leaving out cost is given back by scaling the outer
/// wall, so that every piece holds its counted clay to rounding.
///
/// Errors as `profile_of`. The result is not proved: certify it. Walls of less than a few
/// tolerances may be crossed by the leaving out; then the steps as they are must serve.
Result<StackProfile> smooth_profile_of(const ClayStack& stack, double tolerance_mm);

}  // namespace clay::solid
