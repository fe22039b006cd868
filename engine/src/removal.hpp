#pragma once
#include "claystack/engine/clay_stack.hpp"
#include "claystack/engine/step_plan.hpp"
#include "contact.hpp"

#include <vector>

namespace clay {

/// What leaves each touched ring this tick, in quanta, parallel to `contact.rings`; equations (3)
/// and (4) with Delta v = eps (2R - eps) outside, eps (2r + eps) inside. Writes nothing else.
///
/// `paper`: eps = k (R - r).
/// `conserving`: eps = (R - r)(1 - exp(-kappa dt)), never past the tool's surface and never
/// through the minimum wall; two half steps remove what one step does.
template <Model model>
void compute_removal(const RemovalPlan& plan, const ClayStack& stack, const Contact& contact,
                     double dt_s, std::vector<Quanta>& removed) noexcept;

}  // namespace clay
