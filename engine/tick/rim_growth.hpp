#pragma once
// The height of a pot: rings are added at its rim or taken out there.

#include "claystack/engine/clay.hpp"
#include "claystack/engine/plan.hpp"
#include "engine/clay/stack_writer.hpp"
#include "engine/tick/flow.hpp"
#include "engine/tick/removal.hpp"
#include "engine/tool/tool_state.hpp"

#include <cstddef>
#include <optional>
#include <span>

namespace clay {

/// Steps (a), (b) of section 5.1 without clay rules: whole rings on top from the excess of clay.
/// `conserving` takes them from the crown, and gives them the excess in `rim`; without a rim they
/// are copies. `paper` takes copies from `ledger.outside`.
template <Model model>
void grow_rings(Flow& flow, ClayStack& stack, Ledger& ledger, Rim* rim,
                StackWriter& writer) noexcept;

// For the clay rules.

/// Index of the lowest ring above two tools that stretch a wall as they lift it, or above one tool
/// that stretches a lump; this ring and all rings above it rise unchanged. Empty: the wall grows at
/// the rim.
[[nodiscard]] std::optional<std::size_t> place_of_stretch(
    const StepPlan& plan, const ClayStack& stack, const ToolState& tool,
    std::span<const ToolRemoval> removals) noexcept;

/// Whole rings from the crown. Where the tools stretch the clay, a ring between its neighbours.
/// Below a thin rim that rises, a copy of the wall there.
/// Otherwise, with a rim as `press_clay` makes them, without one below the lip,
/// which is lifted as it is. Where a tool stands beside the lip, on top, as copies of the rim that
/// taper to the wall below where the rim is thicker. A ring rises beside the tools, not into them:
/// a narrow rim that closes leans away from them, any other rim loses a part of the ring. If they
/// leave too little room for it, the clay waits in the crown.
void grow_rim(Flow& flow, const StepPlan& plan, const ToolState& tool,
              std::span<const ToolRemoval> removals, ClayStack& stack, Rim* rim,
              StackWriter& writer) noexcept;
/// The limit of a narrow rim that closes. It rises by a ring of the wall below the lip, or by the
/// top ring.
[[nodiscard]] RimLimit rim_limit(const ClayStack& stack, const Tool& tool, double hip_y,
                                 std::span<const ToolRemoval> removals) noexcept;
/// Takes rings out below the lip until the crown is no longer below 0; where a tool stands beside
/// the lip, on top. Expects that the stack holds enough clay.
void sink_rim(Flow& flow, const Tool& tool, double hip_y, std::span<const ToolRemoval> removals,
              ClayStack& stack, StackWriter& writer) noexcept;

}  // namespace clay
