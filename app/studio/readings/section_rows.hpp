#pragma once
// The section of a pot in as many rows as there are pixels, whatever the number of its rings.

#include "app/render/picture.hpp"
#include "claystack/engine/clay.hpp"

#include <cstddef>
#include <span>
#include <vector>

namespace clay::studio {

/// The rings that reach into one row of pixels: from the largest bore to the least outside there is
/// clay in all of them, from the least bore to the largest outside in some.
struct SectionRow {
  float inner_least_mm = 0.0f, inner_most_mm = 0.0f;
  float outer_least_mm = 0.0f, outer_most_mm = 0.0f;
  friend bool operator==(const SectionRow&, const SectionRow&) = default;
};

/// `rows` equal parts of the stack's height, bottom to top; the crown is a ring of its own.
/// O(rings + rows).
[[nodiscard]] std::vector<SectionRow> section_rows(const ClayStack& stack, std::size_t rows);

/// Thickness of the wall at a height [mm]: the lesser of both faces'; infinite where unknown.
[[nodiscard]] double wall_at_height(std::span<const render::RowWall> walls, double height_mm,
                                    double y_mm);

}  // namespace clay::studio
