#pragma once
// The rest of a finger behind a tool in a bore: no clay closes over it.

#include "claystack/engine/clay.hpp"
#include "claystack/engine/plan.hpp"
#include "engine/clay/stack_writer.hpp"
#include "engine/tick/removal.hpp"
#include "engine/tool/tool_state.hpp"

#include <algorithm>

namespace clay {

/// The rest of a finger, above a tool in a bore. It stands behind the tool, toward the axis, and
/// leans away by 1 : 8. So clay may heave up over the tool, which carries it along on its way out,
/// but does not close behind it. A wall as thick as the tool's diameter yields fully, and a wall as
/// thick as its radius does not yield: a belly may be wider than the neck over it.
struct Finger {
  static constexpr double kLean = 0.125;  ///< radius over height
  double from_mm = 0.0, to_mm = 0.0;      ///< heights of its ends above the wheel head
  double bore_mm = 0.0;                   ///< least radius of the bore at its lower end
  double tool_mm = 1.0;                   ///< greatest radius of the tool

  [[nodiscard]] bool stands() const noexcept { return bore_mm > 0.0; }
  [[nodiscard]] double bore_at(double up_mm) const noexcept {
    return bore_mm - kLean * (up_mm - from_mm);
  }
  /// The fraction by which a wall of this thickness yields to it.
  [[nodiscard]] double part(double wall_mm) const noexcept {
    return std::clamp(wall_mm / tool_mm - 1.0, 0.0, 1.0);
  }
};
/// None if all of the bore is far wider than the finger.
[[nodiscard]] Finger finger_of(const StepPlan& plan, const ToolState& tool, const ClayStack& stack,
                               const Contact& contact) noexcept;
/// Removes the clay in its way above the contact, as fast as a cone does (`yielded`). Adds it to
/// `loose`.
void relieve_finger(const StepPlan& plan, const Finger& finger, const ClayStack& stack, double dt_s,
                    const Contact& contact, StackWriter& writer, LooseClay& loose) noexcept;

}  // namespace clay
