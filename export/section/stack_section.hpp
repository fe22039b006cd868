#pragma once
// Pieces of a stack, and the polygon of each in the section.

#include "claystack/engine/clay.hpp"
#include "claystack/export/section.hpp"

#include <cstddef>
#include <vector>

namespace clay::solid::inline section {

/// The rings `first` to `last`, both included.
struct RingRange {
  std::size_t first = 0;
  std::size_t last = 0;
};

/// The common part of two adjacent rings at their common level.
enum class Contact { annulus, circle, none };
[[nodiscard]] Contact contact_of(const Ring& lower, const Ring& upper) noexcept;

/// Height [mm] of the bottom of ring `ring`; if there is no such ring, of the top of the stack,
/// crown included.
[[nodiscard]] double level_mm(const ClayStack& stack, std::size_t ring) noexcept;

/// Splits the rings wherever two adjacent ones share no annulus.
[[nodiscard]] std::vector<RingRange> pieces_of(const ClayStack& stack, RingRange rings);

/// One for each piece, bottom to top.
[[nodiscard]] std::vector<PieceShape> shapes_of(const ClayStack& stack);

/// The outer wall of a piece from its bottom to its top.
[[nodiscard]] Polygon outer_wall_of(const ClayStack& stack, RingRange piece);

/// The whole section of a piece, counterclockwise: its outer wall upward, its bore or the axis
/// downward. Steps narrower than `min_step_mm` are levelled as described at `profile_of`.
[[nodiscard]] Polygon section_of(const ClayStack& stack, RingRange piece, double min_step_mm = 0.0);

/// The section of the crown alone: foot and top of its outer wall, then of its bore or the axis.
[[nodiscard]] Polygon crown_section_of(const ClayStack& stack);

/// A part of a section that sweeps one shell: from pole to pole if edges on the axis divide the
/// polygon, the whole polygon if it never meets the axis.
struct Chain {
  std::size_t first = 0;  ///< vertex of the polygon
  std::size_t edges = 0;
  bool round = false;
};
[[nodiscard]] std::vector<Chain> chains_of(const Polygon& polygon);

}  // namespace clay::solid::inline section
