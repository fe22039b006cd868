#pragma once
// Place of a pot's axis in its drawing, and the side of the axis on which the pot is drawn.

#include "app/import/half_section.hpp"

#include <glm/vec2.hpp>
#include <string>
#include <vector>

namespace clay::importing {

struct Bounds {
  glm::dvec2 low{1e300}, high{-1e300};
};

[[nodiscard]] Bounds bounds_of(const std::vector<Line>& lines);

/// Sets the axis of the section as the scaled drawing has it, with a note if it is doubtful, and
/// removes axis lines from the drawing. Notes and errors have the coordinates of the file.
Result<void> place_axis(HalfSection& section, Drawing& drawing, const HalfSectionSettings& settings,
                        const std::string& name);

/// Mirrors lines that are wholly left of the axis: a half section may be drawn on either side.
void turn_to_the_right(std::vector<Line>& lines, double axis_mm);

/// A hint for an error about a drawing of both halves that is not quite symmetric, if the axis was
/// not chosen.
[[nodiscard]] std::string hint_about(const Drawing& drawing, const HalfSection& section,
                                     bool chosen);

}  // namespace clay::importing
