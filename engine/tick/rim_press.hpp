#pragma once
// A tool that comes down on a rim or a lump presses it down, and not aside; a cutter lowers it.

#include "claystack/engine/clay.hpp"
#include "claystack/engine/tool.hpp"
#include "engine/tick/contact.hpp"

namespace clay {

/// The two parts of the clay that gives way under one tool: aside, as at a wall, and down, where
/// the rim sinks.
struct RimPress {
  double aside = 1.0;   ///< the part of the motion that goes aside; 1: the rim does not sink
  WideQuanta down = 0;  ///< clay that leaves the rim in this tick [quanta]
};

/// For a contact whose rings have given way. Reduces the distance by which each ring gives way
/// (`TouchedRings::give`) to the part that goes aside.
[[nodiscard]] RimPress press_rim(const Tool& tool, const Motion& motion, const ClayStack& stack,
                                 double hip_y, Contact& contact) noexcept;
/// Call when the clay that goes aside has left the rings. The clay that goes down is at most the
/// crown and 64 rings at the rim; the lowest ring stays.
void limit_to_rim(const ClayStack& stack, RimPress& press) noexcept;

}  // namespace clay
