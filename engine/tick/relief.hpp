#pragma once
// Clay that overhangs the end of a contact yields: a finger leaves no undercut steeper than 2 : 1.

#include "claystack/engine/clay.hpp"
#include "claystack/engine/tick.hpp"
#include "engine/clay/stack_writer.hpp"
#include "engine/tick/band.hpp"
#include "engine/tick/removal.hpp"
#include "engine/tool/tool_state.hpp"

#include <array>
#include <cstddef>
#include <span>

namespace clay {

/// Farthest from a contact that an overhang yields [mm].
inline constexpr double kReliefMm = 12.0;

inline constexpr double kReliefSlope = 2.0;

/// Of a finger that stands nearly upright in a bore.
inline constexpr double kFingerSlope = 0.125;

/// Where a tool's surface becomes steeper than 2 : 1 toward its ends, measured from the HIP [mm];
/// of a tool with flat ends: its ends. A shaft that widens from there as a cone stands for the rest
/// of the finger: what is in its way yields as fast as clay that the tool touches.
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
  /// The part of a finger, 0 to 1, that stands in the bore above the tool and makes the cone steep
  /// and long.
  double finger = 0.0;
  double slope = kReliefSlope, reach_mm = kReliefMm;

  /// How far the cone has drawn back from its base at a height.
  [[nodiscard]] double recess(double up_mm) const noexcept {
    return slope * (up ? up_mm - from_mm : from_mm - up_mm);
  }
  /// How far a surface at a height stands out into the cone.
  [[nodiscard]] double excess(double up_mm, double surface_mm) const noexcept {
    return (outside ? surface_mm - base_mm : base_mm - surface_mm) - recess(up_mm);
  }
};

/// The cones at the lower and the upper end of one of the contacts, which has given way. What
/// stands in them takes more from the rings that the tool touches, and lessens their depth. Those
/// of a cutter begin 1 mm inside the clay: it leaves small steps of its own shape, at a lip.
/// `finger`: of the cone above a tool in a bore.
[[nodiscard]] std::array<Cone, 2> relieve_touched(const StepPlan& plan, const Shoulders& shoulders,
                                                  const ClayStack& stack, const ToolState& tool,
                                                  const Band& band, const Squeeze& squeeze,
                                                  std::span<ToolRemoval> removals,
                                                  std::size_t which, bool trim,
                                                  double finger) noexcept;
/// Takes what stands in a cone beyond the contact, never through the minimum wall, nor where there
/// is no bore. Returns the clay.
WideQuanta relieve_beyond(const StepPlan& plan, const Cone& cone, const ClayStack& stack,
                          double dt_s, const Contact& contact, StackWriter& writer) noexcept;

}  // namespace clay
