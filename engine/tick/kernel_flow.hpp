#pragma once
// Spreads displaced clay over the rings above or below the tool by the Rayleigh kernel
// (section 5.1).

#include "claystack/engine/clay.hpp"
#include "claystack/engine/plan.hpp"
#include "engine/tick/contact.hpp"
#include "engine/tick/rayleigh_kernel.hpp"

#include <cstddef>
#include <cstdint>

namespace clay {

/// Rings above and below the candidate range that a flow may reach.
[[nodiscard]] inline std::size_t flow_reach(const RayleighKernel& kernel) noexcept {
  return kernel.effective_length() + 1;
}

/// The part `inside_share` (alpha in 2^-30) of an amount; 0 while no ring has a bore, because there
/// is no inner surface to add to.
[[nodiscard]] WideQuanta inside_part(WideQuanta amount, std::int64_t inside_share,
                                     const ClayStack& stack) noexcept;

/// Spreads an amount: with `up` from above the candidate range by (5), (6), else downward from
/// below it by (7), (8). alpha goes inside as far as each bore has room (r_j^2 >= share), the rest
/// outside. Returns the clay that finds no ring. With a rim a flow that reaches the top ring
/// records in it the additional clay that the next ring would get.
///
/// `conserving` starts the kernel at the tool's ends, not at the ends of their rings (Contact's
/// offsets).
WideQuanta flow_by_kernel(const StepPlan& plan, WideQuanta amount, bool up, const Contact& contact,
                          Rim* rim, ClayStack& stack) noexcept;

}  // namespace clay
