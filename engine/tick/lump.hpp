#pragma once
// Solid clay that one tool presses from the side (`ClaySpec::pressed_lump_stretches`).

#include "claystack/engine/clay.hpp"
#include "claystack/engine/plan.hpp"
#include "engine/tick/band.hpp"
#include "engine/tick/removal.hpp"
#include "engine/tool/tool_state.hpp"

#include <cstddef>
#include <optional>
#include <span>

namespace clay {

/// Index of the ring below which a solid column that one tool presses from outside becomes longer:
/// all rings from there on rise as they are. The stack's size if the contact reaches the top. Empty
/// where the clay is not solid, or the tool comes from inside or goes down: that pushes the clay
/// down, and the neck that the tool leaves would become a long stem.
[[nodiscard]] std::optional<std::size_t> place_in_lump(
    const StepPlan& plan, const ClayStack& stack, const ToolState& tool,
    std::span<const ToolRemoval> removals) noexcept;

/// The part of the clay that one tool squeezes out of a lump by which its column becomes longer.
/// `yields_mm`: height of the clay that yields.
[[nodiscard]] double stretched_part(const ClayStack& stack, const Band& band,
                                    double yields_mm) noexcept;
/// That part of this amount, or less if the tool goes down.
[[nodiscard]] WideQuanta stretched_clay(WideQuanta squeezed, const ClayStack& stack,
                                        const Band& band, double yields_mm,
                                        double upward_mm_s) noexcept;

}  // namespace clay
