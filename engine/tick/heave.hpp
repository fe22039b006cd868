#pragma once
// The place of clay that a tool squeezes aside: it heaves up the wall beside the contact.

#include "claystack/engine/clay.hpp"
#include "engine/clay/stack_writer.hpp"
#include "engine/tick/band.hpp"
#include "engine/tick/finger.hpp"
#include "engine/tick/wall_radii.hpp"

namespace clay {

/// Most that is laid at once: shares are whole quanta in floating point.
inline constexpr Quanta kLargestHeap = Quanta{1} << 50;

/// An amount to lay on the wall from one end of a band, at most `kLargestHeap`.
struct Heap {
  Quanta inside = 0, outside = 0;
  bool up = true;                  ///< from the upper end upward
  double reach_mm = 1.0;           ///< `heave_reach`
  double slope = 0.5;              ///< steepest: change of thickness over height
  const Finger* finger = nullptr;  ///< in the bore above the tool; nothing is laid into it
};

/// No clay makes a bore narrower than this radius, or a hole would close and enclose a cavity. [mm]
inline constexpr double kLeastBoreMm = 0.1;

/// Maximum distance from the band at which clay is heaved: 0.8 (c + min(w, width of the tool)), at
/// least a ring, at most `kLongestShellMm` [mm].
[[nodiscard]] double heave_reach(const Tool& tool, const ClayStack& stack,
                                 const Band& band) noexcept;

/// Lays clay beside the band: up to a distance x the share t^3 (10 - 15 t + 6 t^2), t = x / reach,
/// which begins and ends with slope 0. A ring becomes thicker than its thinner neighbour
/// by at most `slope` times h. Rings below 0.085 mm are compared with the ring 0.17 mm away. No
/// ring grows into the tool of this contact. Clay that a ring cannot take goes to the next ones, as
/// far as twice the reach. Returns the clay that found no place. The caller counts the placed clay
/// (`StackWriter::gain`).
Quanta heave(const Tool& tool, const ClayStack& stack, WallRadii& walls, double hip_y,
             const Contact& contact, const Band& band, const Heap& heap,
             StackWriter& writer) noexcept;

}  // namespace clay
