#pragma once
// Takes clay off the rings that a tool touches, and gives it to other rings (section 5.1) or cuts
// it off (section 8).

#include "claystack/engine/clay.hpp"
#include "claystack/engine/plan.hpp"
#include "engine/tick/flow.hpp"
#include "engine/tick/removal.hpp"

#include <span>

namespace clay {

/// Takes off the clay that the tools remove, and returns it.
WideQuanta remove_clay(std::span<const ToolRemoval> removals, ClayStack& stack, Rim* rim) noexcept;

/// Takes off the clay that the tools remove and spreads it, all of it at once, by the kernel
/// (kernel_flow.hpp): upward when the tool moves up, downward when it moves down. One tool, or the
/// two of a pinch, which have one candidate range. Clay that finds no ring below goes up; clay that
/// finds no ring above becomes height.
///
/// `conserving` gives new rings the excess in `rim`; without a rim they are copies.
template <Model model>
Flow press_clay(const StepPlan& plan, std::span<const ToolRemoval> removals, bool upward,
                ClayStack& stack, Ledger& ledger, Rim* rim = nullptr) noexcept;

/// The paper's chiselling (section 8): the removed clay leaves the pot and is counted as trimmed.
template <Model model>
Flow trim_clay(std::span<const ToolRemoval> removals, ClayStack& stack, Ledger& ledger,
               Rim* rim = nullptr) noexcept;

}  // namespace clay
