#pragma once
// Rings of equal height whose bounds meet the level lines of a drawing.

#include "app/import/half_section.hpp"

#include <cstddef>
#include <vector>

namespace clay::importing {

/// Heights at which the drawing has a level line: foot and rim, floors, treads.
[[nodiscard]] std::vector<double> drawn_levels(const HalfSection& section);

/// The number of rings, from `fewest` to twice as many, but not above `most`, whose bounds are
/// nearest to all levels.
[[nodiscard]] std::size_t fitting_ring_count(const std::vector<double>& levels, std::size_t fewest,
                                             std::size_t most);

/// The section with each level moved to the nearest bound of `count` rings, and everything between
/// stretched with it. A level whose bound is taken by a lower one is moved with its surroundings.
[[nodiscard]] std::vector<Slab> on_ring_bounds(const HalfSection& section,
                                               const std::vector<double>& levels,
                                               std::size_t count);

}  // namespace clay::importing
