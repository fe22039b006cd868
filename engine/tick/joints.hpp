#pragma once
// Contact of neighbouring rings, and the rules that keep them joined under a tool
// (docs/clay-rules.md, Joints).

#include "claystack/engine/clay.hpp"
#include "engine/clay/stack_writer.hpp"
#include "engine/tick/removal.hpp"

#include <cstddef>
#include <optional>
#include <span>

namespace clay {

/// Part of the minimum wall by which a press keeps neighbouring rings overlapping.
inline constexpr double kJointPart = 0.25;

/// Whether some neighbours overlap by less than `least_mm`. May also return true where they overlap
/// by less than twice that.
[[nodiscard]] bool has_weak_joint(std::span<const Ring> rings, double least_mm) noexcept;

/// The lowest of the rings first..last-1 that does not touch the one above it.
[[nodiscard]] std::optional<std::size_t> lowest_gap(std::span<const Ring> rings, std::size_t first,
                                                    std::size_t last) noexcept;

/// Rule for rings that follow a press.
struct Following {
  bool outward = false;
  double least_mm = 0.0;     ///< minimum overlap, or half of the thinner wall if less
  double min_wall_mm = 0.0;  ///< a ring at its minimum keeps its thickness, with clay of the crown
};

/// Moves those of the rings first..last that overlap a neighbour by too little, in the direction of
/// the press. They keep their volume, unless they become thinner than the minimum. The crown may
/// then be below 0; the rings above have enough clay for it.
void join_rings(const ClayStack& stack, std::size_t first, std::size_t last,
                const Following& following, StackWriter& writer) noexcept;

/// Two tools that hold a wall.
struct Hands {
  const Tool& tool;
  double hip_y = 0.0;  ///< [mm]
  std::span<const ToolRemoval> removals;
};

/// Two tools press both ways, so no ring follows them. Those of the rings first..last that overlap
/// a neighbour by too little become thicker towards it, unless they would go into a tool. The crown
/// may then be below 0, as above.
void thicken_joints(const ClayStack& stack, std::size_t first, std::size_t last, double least_mm,
                    const Hands& hands, StackWriter& writer) noexcept;

}  // namespace clay
