#pragma once
// Section 5.1: where displaced clay goes. The only stage that writes the stack.

#include "claystack/engine/clay.hpp"
#include "claystack/engine/tick.hpp"
#include "engine/tick/removal.hpp"

#include <cstddef>
#include <span>

namespace clay {

/// What a tick's flow did to the stack.
struct Flow {
  std::size_t lowest = 0;  ///< rings lowest..highest may have changed
  std::size_t highest = 0;
  std::size_t grown = 0;    ///< rings added on top
  bool ring_limit = false;  ///< clay waits for a ring that max_rings does not allow
};

/// Rings above and below the candidate range that a flow may reach.
[[nodiscard]] inline std::size_t flow_reach(const RayleighKernel& kernel) noexcept {
  return kernel.effective_length() + 1;
}

/// Takes what the tools bite off and spreads it, all of it at once, by the Rayleigh kernel: upward
/// from above the candidate range by (5), (6) when the tool moves up, downward from below it by
/// (7), (8) when it moves down. One bite, or the two of a pinch, which have one candidate range.
/// alpha goes inside as far as each bore has room (r_j^2 >= share), the rest outside. What finds no
/// ring below goes up; what finds none above becomes height.
///
/// `conserving` lays the kernel to the tool's ends, not to the ends of their rings (Contact's
/// offsets), and gives new rings what `rim` has counted; without a rim they are copies.
template <Model model>
Flow press_clay(const StepPlan& plan, std::span<const ToolRemoval> bites, bool upward,
                ClayStack& stack, Ledger& ledger, Rim* rim = nullptr) noexcept;

/// The paper's chiselling (section 8): what is bitten off leaves the pot and is booked as trimmed.
template <Model model>
Flow trim_clay(std::span<const ToolRemoval> bites, ClayStack& stack, Ledger& ledger,
               Rim* rim = nullptr) noexcept;

}  // namespace clay
