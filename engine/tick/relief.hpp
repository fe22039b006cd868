#pragma once
// Clay that overhangs the end of a contact yields: a finger leaves no undercut steeper than 2 : 1.

#include "claystack/engine/clay.hpp"
#include "claystack/engine/plan.hpp"
#include "engine/clay/stack_writer.hpp"
#include "engine/tick/band.hpp"
#include "engine/tick/removal.hpp"
#include "engine/tool/tool_state.hpp"

#include <array>
#include <cstddef>
#include <span>

namespace clay {

/// Farthest from a contact that an overhang yields [mm]: bounds the work of a tick for any pot.
inline constexpr double kReliefMm = 35.0;

inline constexpr double kReliefSlope = 2.0;

/// Heights at which a tool's surface becomes steeper than 2 : 1 toward its ends, measured from the
/// HIP [mm]; of a tool with flat ends: its ends. A shaft that widens from there as a cone
/// represents the rest of the finger: clay in its way yields as fast as clay that the tool touches.
struct Shoulders {
  double low_mm = 0.0, high_mm = 0.0;
};
[[nodiscard]] Shoulders shoulders_of(const Tool& tool);

/// The cone at one end of a contact. [mm]
struct Cone {
  double from_mm = 0.0;    ///< height at which it begins
  double base_mm = 0.0;    ///< radius of the tool's surface there
  std::size_t beside = 0;  ///< the last touched ring before it
  bool outside = true, up = true;
  bool meets = false;  ///< clay beyond the contact

  /// Depth of a surface at a height in the cone [mm]; below 0: clear of it.
  [[nodiscard]] double excess(double up_mm, double surface_mm) const noexcept {
    const double way = up ? up_mm - from_mm : from_mm - up_mm;
    return (outside ? surface_mm - base_mm : base_mm - surface_mm) - kReliefSlope * way;
  }
};

/// The cones at the lower and the upper end of one of the contacts, which has given way. For clay
/// in them, more is removed from the rings that the tool touches, and their depth decreases. Those
/// of a cutter begin 1 mm inside the clay: it leaves small steps with the shape of the cutter at a
/// lip.
[[nodiscard]] std::array<Cone, 2> relieve_touched(const StepPlan& plan, const Shoulders& shoulders,
                                                  const ClayStack& stack, const ToolState& tool,
                                                  const Band& band, const Squeeze& squeeze,
                                                  std::span<ToolRemoval> removals,
                                                  std::size_t which, bool trim) noexcept;

/// The clay that leaves a ring whose surface projects by `out` [mm]: d out / dt = -kappa (R - r)
/// min(1, out / yield depth), by a step that cannot go too far. Afterwards `out` is the distance by
/// which the surface moves.
[[nodiscard]] Quanta yielded(const RemovalPlan& plan, double dt_s, const Ring& ring, bool outside,
                             double& out) noexcept;

/// Removes the clay in a cone beyond the contact, never through the minimum wall, nor where there
/// is no bore. Adds it to `loose`. With `bends`, for a cone outside, a thin wall instead moves
/// inward as far as it is thin and keeps its clay, but for half of its hoop strain: that, and the
/// clay by which the ring is thicker than the wall beyond it, is added to `loose`. Returns the
/// number of rings that yield.
std::size_t relieve_beyond(const StepPlan& plan, const Cone& cone, const ClayStack& stack,
                           double dt_s, const Contact& contact, bool bends, StackWriter& writer,
                           LooseClay& loose) noexcept;

}  // namespace clay
