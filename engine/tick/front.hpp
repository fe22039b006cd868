#pragma once
#include "claystack/engine/clay.hpp"
#include "claystack/engine/tick.hpp"
#include "engine/tick/contact.hpp"

namespace clay {

/// Measures the clay within a ring for the force; `conserving`, after the removal of a tick of
/// `dt_s`. Moves no clay.
///
/// Rings yield as a whole, once the tool's end has passed their middle. Clay yields from when the
/// end comes by: behind an end that runs under a bulge the depth falls by kappa (R - r) for each
/// second since, from that of the clay ahead to that of the clay that has yielded. The ring of the
/// leading end and the one behind it are felt so, by `contact.front`; the parts of rings at either
/// end that have not yielded are felt as deep as their neighbours.
void measure_front(const StepPlan& plan, const ClayStack& stack, double hip_y, double dt_s,
                   Contact& contact) noexcept;

}  // namespace clay
