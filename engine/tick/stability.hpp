#pragma once
// Section 7: the check that every ring carries the load on it.

#include "claystack/engine/clay.hpp"
#include "claystack/engine/plan.hpp"
#include "engine/clay/ring_sums.hpp"
#include "engine/tick/flow.hpp"

#include <cstddef>
#include <optional>

namespace clay {

struct Failure {
  std::size_t ring = 0;
  double stress_kpa = 0.0;
};

/// Stress is examined only where it can have risen. Clay moves locally, so the weight above a ring
/// changes only between the places that lost clay and those that got it: rings lowest..highest of
/// the flow. The weight above `highest` is carried along as the tool moves a little, and summed
/// from blocks of rings when it jumps. The blocks are updated when a few hundred rings have
/// changed, not at every tick.
class StabilityWatch {
 public:
  StabilityWatch() = default;
  /// O(N), with the memory for max_rings().
  explicit StabilityWatch(const ClayStack& stack);

  /// Before the flow: computes the weight above ring `highest`. It takes at most a constant number
  /// of steps plus the length of the last flow, at any distance from it.
  void move_to(const ClayStack& stack, std::size_t highest) noexcept;

  /// After it, with `highest` as given to move_to: the ring of greatest stress among those above
  /// the threshold, if any, or a lower ring that has parted from the ring above it. Finds the same
  /// stress as check_all, if that found none before the flow. Reads the rings of the flow and the
  /// new ones. If clay has come on top from far below, it also reads the blocks whose thinnest
  /// ring could not carry the weight above the lower end of the block.
  [[nodiscard]] std::optional<Failure> check(const StabilityPlan& plan, const ClayStack& stack,
                                             const Flow& flow) noexcept;

  /// Over the whole stack: O(N), for scene build and for tests.
  [[nodiscard]] static std::optional<Failure> check_all(const StabilityPlan& plan,
                                                        const ClayStack& stack) noexcept;

 private:
  void note_change(std::span<const Ring> rings, std::size_t first, std::size_t last) noexcept;
  static void note_parted(const StabilityPlan& plan, const ClayStack& stack, const Flow& flow,
                          std::optional<Failure>& worst) noexcept;
  void note_lip(std::span<const Ring> rings, const Flow& flow, bool at_top) noexcept;
  void bring_up_to_date(std::span<const Ring> rings) noexcept;
  [[nodiscard]] std::optional<Failure> search(const StabilityPlan& plan,
                                              const ClayStack& stack) noexcept;

  std::size_t cursor_ = 0;
  WideQuanta above_cursor_ = 0;        ///< of rings above cursor_, without the crown
  WideQuanta volume_ = 0, crown_ = 0;  ///< of the stack, before the flow
  RingSums sums_;
  std::size_t stale_first_ = 0, stale_end_ = 0;  ///< rings that sums_ does not include yet
};

}  // namespace clay
