#pragma once
// Moves displaced clay along the wall (section 5.1).

#include "claystack/engine/clay.hpp"
#include "claystack/engine/plan.hpp"
#include "engine/tick/flow.hpp"
#include "engine/tick/rayleigh_kernel.hpp"
#include "engine/tick/removal.hpp"

#include <cstddef>
#include <cstdint>
#include <span>

namespace clay {

/// Rings above and below the candidate range that a flow may reach.
[[nodiscard]] inline std::size_t flow_reach(const RayleighKernel& kernel) noexcept {
  return kernel.effective_length() + 1;
}

/// Takes off the clay that the tools remove and spreads it, all of it at once, by the Rayleigh
/// kernel: upward from above the candidate range by (5), (6) when the tool moves up, downward from
/// below it by (7), (8) when it moves down. One tool, or the two of a pinch, which have one
/// candidate range. alpha goes inside as far as each bore has room (r_j^2 >= share), the rest
/// outside. Clay that finds no ring below goes up; clay that finds no ring above becomes height.
///
/// `conserving` starts the kernel at the tool's ends, not at the ends of their rings (Contact's
/// offsets), and gives new rings the excess in `rim`; without a rim they are copies.
template <Model model>
Flow press_clay(const StepPlan& plan, std::span<const ToolRemoval> removals, bool upward,
                ClayStack& stack, Ledger& ledger, Rim* rim = nullptr) noexcept;

/// The paper's chiselling (section 8): the removed clay leaves the pot and is counted as trimmed.
template <Model model>
Flow trim_clay(std::span<const ToolRemoval> removals, ClayStack& stack, Ledger& ledger,
               Rim* rim = nullptr) noexcept;

// Parts of these, for the clay rules.

/// Takes off the clay that the tools remove.
WideQuanta remove_clay(std::span<const ToolRemoval> removals, ClayStack& stack, Rim* rim) noexcept;
/// alpha of an amount, as long as some ring has a bore.
[[nodiscard]] WideQuanta inside_part(WideQuanta amount, std::int64_t inside_share,
                                     const ClayStack& stack) noexcept;
/// Spreads an amount by the kernel; returns the clay that finds no ring.
WideQuanta flow_by_kernel(const StepPlan& plan, WideQuanta amount, bool up, const Contact& contact,
                          Rim* rim, ClayStack& stack) noexcept;

}  // namespace clay
