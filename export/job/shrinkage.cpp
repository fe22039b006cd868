#include "claystack/export/job.hpp"

#include "claystack/engine/clay.hpp"
#include "core/text.hpp"

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>
#include <vector>

namespace clay::solid::inline job {
namespace {

Quanta times(Quanta count, double factor) {
  return static_cast<Quanta>(std::llround(factor * static_cast<double>(count)));
}

/// Of one ring; a wall of a few quanta stays one.
Ring times(const Ring& ring, double factor) {
  Ring larger{times(ring.outer2, factor), times(ring.inner2, factor)};
  if (larger.inner2 >= larger.outer2) larger.inner2 = larger.outer2 - 1;
  return larger;
}

/// The part of a ring that the crown has does not change, whatever rounding did to that ring.
WideQuanta crown_of(const ClayStack& stack, const Ring& larger_top) {
  const double part =
      static_cast<double>(stack.crown()) / static_cast<double>(stack.rings().back().volume());
  return std::min(times(larger_top.volume(), part), larger_top.volume() - 1);
}

}  // namespace

Result<Pot> enlarged(const Pot& pot, double shrinkage) {
  if (!(shrinkage >= 0.0 && shrinkage <= kMostShrinkage))
    return failure(ErrorKind::bad_input, "shrinkage: expected 0 to " + in_mm(kMostShrinkage) +
                                             ", found " + in_mm(shrinkage));
  if (shrinkage == 0.0) return pot;
  const double factor = enlargement(shrinkage);
  std::vector<Ring> rings;
  rings.reserve(pot.stack.size());
  // A double holds no radius of more than 362 mm to the quantum; nor does any file.
  for (const Ring& ring : pot.stack.rings()) rings.push_back(times(ring, factor * factor));
  const WideQuanta crown = crown_of(pot.stack, rings.back());
  return ClayStack::from_rings(pot.stack.ring_height_mm() * factor, std::move(rings), crown,
                               pot.stack.max_rings())
      .map_error([](const Error& error) {
        return Error{error.kind, "enlarged for its shrinkage: " + error.message};
      })
      .map([&](ClayStack stack) {
        Pot larger = pot;
        larger.stack = std::move(stack);
        larger.rim = {};
        larger.ledger = {.initial = larger.stack.volume()};
        larger.rounding.reset();
        if (larger.collapse) {
          larger.collapse->pivot_mm *= factor;
          larger.collapse->shift_mm *= factor;
        }
        return larger;
      });
}

}  // namespace clay::solid::inline job
