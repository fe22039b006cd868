#pragma once
#include "claystack/core/result.hpp"
#include "claystack/engine/clay.hpp"

namespace clay::solid::inline job {

struct DrainedStack {
  ClayStack stack;
  double drilled_mm3 = 0.0;  ///< clay that the drill took
};

/// The stack with a hole of this diameter along the axis, from its foot up into the uppermost
/// closed cavity, so that no cavity stays closed; through floors in the way as well. Errors
/// (bad_input): no cavity to drain; a hole that leaves a ring, named, without a wall.
Result<DrainedStack> drain(const ClayStack& stack, double diameter_mm);

}  // namespace clay::solid::inline job
