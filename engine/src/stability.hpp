#pragma once
// Section 7: does every ring carry what stands on it?

#include "claystack/engine/clay_stack.hpp"
#include "claystack/engine/step_plan.hpp"

#include <cstddef>
#include <optional>

namespace clay {

struct Failure {
  std::size_t ring = 0;
  double stress_kpa = 0.0;
};

/// beta_i = g M_i / (pi (R_i^2 - r_i^2)) [kPa], M_i the mass of all above ring i, crown included.
/// The paper leaves out g and so compares a mass per area; with g the threshold is a stress.
[[nodiscard]] double stress_kpa(const StabilityPlan& plan, WideQuanta above, Quanta ring) noexcept;

/// Stress is looked at only where it can have risen. Clay moves locally, so the weight above a ring
/// changes only between where clay left and where it came: rings lowest..highest of the flow.
/// The weight above `highest` is carried along as the tool moves.
class StabilityWatch {
 public:
  /// Before the flow: makes the weight above ring `highest` known, in O(distance moved).
  void move_to(const ClayStack& stack, std::size_t highest) noexcept;

  /// After it: the ring of greatest stress among those above the threshold, if any, in
  /// O(highest - lowest + grown). `highest` as given to move_to.
  [[nodiscard]] std::optional<Failure> check(const StabilityPlan& plan, const ClayStack& stack,
                                             std::size_t lowest, std::size_t grown) noexcept;

  /// Over the whole stack: O(N), for scene build and for tests.
  [[nodiscard]] static std::optional<Failure> check_all(const StabilityPlan& plan,
                                                        const ClayStack& stack) noexcept;

 private:
  std::size_t cursor_ = 0;
  WideQuanta above_cursor_ = 0;  ///< of rings above cursor_, without the crown
  bool placed_ = false;
};

}  // namespace clay
