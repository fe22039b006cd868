#pragma once
#include "claystack/engine/clay.hpp"
#include "claystack/engine/tick.hpp"
#include "engine/tick/contact.hpp"

#include <vector>

namespace clay {

/// One tool's contact, and what it takes from each ring of it this tick [quanta]. Storage is
/// reserved once.
struct ToolRemoval {
  Contact contact;
  std::vector<Quanta> removed;
};

/// What leaves each touched ring this tick, in quanta, parallel to `contact.rings`; equations (3)
/// and (4) with Delta v = eps (2R - eps) outside, eps (2r + eps) inside. Writes nothing else.
///
/// `paper`: eps = k (R - r).
/// `conserving`: as yielding.hpp says, never past the tool's surface and never through the minimum
/// wall; leaves to the contact the depths that are left. Two half steps remove what one step does.
template <Model model>
void compute_removal(const RemovalPlan& plan, const ClayStack& stack, double dt_s, Contact& contact,
                     std::vector<Quanta>& removed) noexcept;

/// What two tools take from one wall, each from its own side, that it is nowhere thinner for them
/// than the gap. Equations (3) and (4) at once:
///
/// `paper`: k (R - r) each.
/// `conserving`: dR/dt = -kappa (R - r) and dr/dt = kappa (R - r), each until its tool's surface is
/// reached, both until the minimum wall is; solved in closed form, and no faster than a surface
/// yields to one tool near it. Both surfaces move alike: the middle of the wall stays.
template <Model model>
void compute_pinch_removal(const RemovalPlan& plan, const ClayStack& stack, double gap_mm,
                           double dt_s, ToolRemoval& outer, ToolRemoval& inner) noexcept;

}  // namespace clay
