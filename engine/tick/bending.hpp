#pragma once
// One tool moves the wall that it presses: the wall bends as a shell about the contact.

#include "claystack/engine/clay.hpp"
#include "claystack/engine/plan.hpp"
#include "engine/tick/band.hpp"
#include "engine/tick/contact.hpp"
#include "engine/tick/shift.hpp"
#include "engine/tick/wall_radii.hpp"

#include <cstddef>
#include <span>

namespace clay {

/// Numbers that `bend_wall` needs room for, for a tool that touches at most this number of rings.
[[nodiscard]] constexpr std::size_t sums_for(std::size_t contacts) noexcept {
  return 3 * contacts + 3;
}

/// Sets `shift` for one tool, whose contact has given way. A wall that does not bend (a solid lump)
/// leaves it as it is. `sums`: scratch, of `sums_for` numbers.
void bend_wall(const StepPlan& plan, const Motion& motion, const ClayStack& stack,
               const Contact& contact, const Band& band, WallRadii& walls, std::span<double> sums,
               const RimLimit& rim, Shift& shift) noexcept;

}  // namespace clay
