#pragma once
#include "claystack/engine/clay.hpp"
#include "claystack/engine/plan.hpp"
#include "engine/tick/contact.hpp"

namespace clay {

/// Measures the clay within a ring for the force; `conserving`, after the removal of a tick of
/// `dt_s`. Moves no clay.
///
/// Rings yield as a whole, once the tool's end has passed their middle. Real clay yields from the
/// moment the end passes it: behind an end that runs under a bulge the depth falls by kappa (R - r)
/// per second, from that of the clay ahead to that of the clay that has yielded. `contact.front`
/// holds this for the ring of the leading end and the one behind it. The parts of rings at either
/// end that have not yielded count as deep as their neighbours.
void measure_front(const StepPlan& plan, const ClayStack& stack, double hip_y, double dt_s,
                   Contact& contact) noexcept;

}  // namespace clay
