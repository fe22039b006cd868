#pragma once
// Clay shrinks as it dries and is fired: what shall come out at a size is made larger.

#include "claystack/engine/pot.hpp"
#include "claystack/engine/result.hpp"

namespace clay::solid {

/// Nothing shrinks by more, and still is a pot.
inline constexpr double kMostShrinkage = 0.5;

/// Lengths grow by this where a piece loses the part `shrinkage` of each: 1 / (1 - s).
[[nodiscard]] constexpr double enlargement(double shrinkage) noexcept {
  return 1.0 / (1.0 - shrinkage);
}

/// `pot` in such a size that it has its own once it has shrunk: heights, radii and the way that a
/// collapsed part fell times 1 / (1 - s), so that clay grows by 1 / (1 - s)^3. Radii squared are
/// rounded to the nearest quantum; the ledger begins with what the result holds.
/// Errors of kind `bad_input`: a shrinkage outside 0 to kMostShrinkage, a result beyond the limits
/// of ClayStack.
Result<Pot> enlarged(const Pot& pot, double shrinkage);

}  // namespace clay::solid
