#pragma once
// A tool that comes down on the rim of a wall presses it down, and not aside.

#include "claystack/engine/clay.hpp"
#include "claystack/engine/tool.hpp"
#include "engine/tick/contact.hpp"
#include "engine/tick/removal.hpp"

namespace clay {

/// How the clay under one tool gives way: in part aside, as at a wall, and in part down, where the
/// rim sinks.
struct RimPress {
  double aside = 1.0;   ///< the part of the motion that goes aside; 1: the rim does not sink
  WideQuanta down = 0;  ///< clay that leaves the rim in this tick [quanta]
};

/// For a contact whose rings have given way. What each ring gives (`TouchedRings::give`) becomes
/// the part that goes aside.
[[nodiscard]] RimPress press_rim(const Tool& tool, const Motion& motion, const ClayStack& stack,
                                 double hip_y, Contact& contact) noexcept;
/// The clay that goes down is at most that of 64 rings at the rim, after the shift and the removal.
/// The lowest ring stays.
void limit_to_rim(const ClayStack& stack, const Squeeze& squeeze, const ToolRemoval& removal,
                  RimPress& press) noexcept;

}  // namespace clay
