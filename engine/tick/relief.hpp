#pragma once
// What overhangs the end of a contact yields: a finger leaves no undercut that is steeper than 2
// : 1.

#include "claystack/engine/clay.hpp"
#include "claystack/engine/tick.hpp"
#include "engine/clay/stack_writer.hpp"
#include "engine/tick/band.hpp"
#include "engine/tick/removal.hpp"

#include <cstddef>
#include <span>

namespace clay {

/// Farthest from a contact that an overhang yields [mm].
inline constexpr double kReliefMm = 12.0;

/// Where a tool's surface becomes steeper than 2 : 1 toward its ends, measured from the HIP [mm];
/// of a tool with flat ends: its ends. A shaft that widens from there as a cone stands for the rest
/// of the finger: what is in its way yields as fast as clay that the tool touches.
struct Shoulders {
  double low_mm = 0.0, high_mm = 0.0;
};
[[nodiscard]] Shoulders shoulders_of(const Tool& tool);

/// A tool in the clay, and its contact.
struct Overhang {
  const Tool& tool;
  const Shoulders& shoulders;
  const RemovalPlan& plan;
  double hip_y = 0.0, dt_s = 0.0;
};

/// Takes more from the rings that a tool touches beyond its shoulders, and lessens their depth.
void relieve_touched(const Overhang& overhang, const ClayStack& stack, const Band& band,
                     const Squeeze& squeeze, std::span<ToolRemoval> removals,
                     std::size_t tool) noexcept;
/// Whether there is clay in the cone's way beyond an end of the contact.
[[nodiscard]] bool overhangs(const Overhang& overhang, const ClayStack& stack, const Band& band,
                             const Contact& contact, bool up) noexcept;
/// Takes it, never through the minimum wall, nor where there is no bore. Returns the clay.
WideQuanta relieve_beyond(const Overhang& overhang, const ClayStack& stack, const Band& band,
                          const Contact& contact, StackWriter& writer) noexcept;

}  // namespace clay
