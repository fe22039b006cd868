#include "claystack/engine/clay.hpp"

#include "core/text.hpp"
#include "engine/clay/radius_grid.hpp"

#include <algorithm>
#include <string>
#include <utility>

namespace clay {
namespace {

Ring rounded(const Ring& ring, const RadiusGrid& grid) {
  const auto inner = std::max<std::int64_t>(grid.steps(ring.inner2), ring.inner2 > 0 ? 1 : 0);
  return {grid.square(grid.steps(ring.outer2)), grid.square(inner)};
}

tl::unexpected<Error> too_coarse(std::size_t ring, double precision_mm, const std::string& why) {
  return failure(ErrorKind::bad_input, "ring " + std::to_string(ring) +
                                           ": expected radii that can be rounded to " +
                                           number_text(precision_mm) + " mm, found " + why);
}

Result<std::vector<Ring>> rounded_rings(const ClayStack& stack, const RadiusGrid& grid,
                                        double precision_mm) {
  const auto exact = stack.rings();
  std::vector<Ring> rings;
  rings.reserve(exact.size());
  for (std::size_t i = 0; i < exact.size(); ++i) {
    rings.push_back(rounded(exact[i], grid));
    if (rings[i].inner2 >= rings[i].outer2)
      return too_coarse(i, precision_mm,
                        "a wall that would vanish, from " + number_text(exact[i].inner_mm()) +
                            " mm to " + number_text(exact[i].outer_mm()) + " mm");
    if (i > 0 && exact[i].touches(exact[i - 1]) && !rings[i].touches(rings[i - 1]))
      return too_coarse(i, precision_mm, "one that would no longer touch the ring below");
  }
  return rings;
}

}  // namespace

Result<Pot> rounded_pot(const Pot& pot, double precision_mm) {
  const auto grid = RadiusGrid::of(precision_mm);
  if (!grid)
    return failure(ErrorKind::bad_input,
                   "expected a precision from 0.00001 to 1 mm, in whole nanometres, found " +
                       number_text(precision_mm) + " mm");
  if (pot.rounding && precision_mm < pot.rounding->to_mm)
    return failure(ErrorKind::bad_input,
                   "expected a precision of " + number_text(pot.rounding->to_mm) +
                       " mm or coarser, as the pot is rounded to that, found " +
                       number_text(precision_mm) + " mm");
  return rounded_rings(pot.stack, *grid, precision_mm)
      .and_then([&](std::vector<Ring> rings) {
        return ClayStack::from_rings(pot.stack.ring_height_mm(), std::move(rings),
                                     pot.stack.crown(), pot.stack.max_rings());
      })
      .map([&](ClayStack stack) {
        Pot result = pot;
        result.stack = std::move(stack);
        result.rim = {};
        result.ledger = {.initial = result.stack.volume()};
        result.rounding = {precision_mm,
                           pot.rounding ? pot.rounding->exact_volume : pot.stack.volume()};
        return result;
      });
}

double volume_change_mm3(const Pot& pot) noexcept {
  if (!pot.rounding) return 0.0;
  return static_cast<double>(pot.stack.volume() - pot.rounding->exact_volume) *
         pot.stack.mm3_per_quantum();
}

}  // namespace clay
