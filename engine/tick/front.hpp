#pragma once
#include "claystack/engine/clay.hpp"
#include "claystack/engine/plan.hpp"
#include "engine/tick/contact.hpp"

#include <array>

namespace clay {

/// A flat end of a tool that presses against the clay ahead of it. That clay is as stiff as the
/// clay beside the tool, K' per area: it resists by K' depth per mm of way, and gives way at K'
/// depth^2 / 2, after half the depth. The force depends on the way alone, so a slow hand and the
/// steps of an encoder cause no pulses, and the force never returns more energy than it took.
struct FlatEnd {
  double pressed_mm = 0.0;  ///< of its way, 0 to depth / 2
  double depth_mm = 0.0;    ///< in the clay ahead

  /// `way_mm`: towards the clay ahead.
  void advance(double way_mm, double ahead_mm) noexcept;
  /// Fraction of the force at which the clay gives way, 0 to 1.
  [[nodiscard]] double part() const noexcept {
    return depth_mm > 0.0 ? 2.0 * pressed_mm / depth_mm : 0.0;
  }
};
/// The lower end, and the upper one.
using FlatEnds = std::array<FlatEnd, 2>;

/// The motion of a tool's ends in scenes with clay rules.
struct EndMotion {
  double upward_mm_s = 0.0;  ///< mean of the last ticks
  FlatEnds& ends;
};

/// Measures the clay within a ring for the force; `conserving`, after the removal of a tick of
/// `dt_s`. Moves no clay.
///
/// Rings yield as a whole, once the tool's end has passed their middle. Real clay yields from the
/// moment the end passes it: behind an end that runs under a bulge the depth falls by kappa (R - r)
/// per second, from that of the clay ahead to that of the clay that has yielded. `contact.front`
/// holds this for the ring of the leading end and the one behind it. The parts of rings at either
/// end that have not yielded count as deep as their neighbours.
///
/// Without `motion` the speed is that of the tick, and a flat end leads while it moves.
void measure_front(const StepPlan& plan, const ClayStack& stack, double hip_y, double dt_s,
                   Contact& contact, EndMotion* motion = nullptr) noexcept;

}  // namespace clay
