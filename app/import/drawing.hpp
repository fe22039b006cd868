#pragma once
// What somebody drew of a pot elsewhere: lines in the plane, whatever file they came in.

#include "claystack/core/result.hpp"

#include <cstddef>
#include <glm/vec2.hpp>
#include <string>
#include <string_view>
#include <vector>

namespace clay::importing {

/// Straight pieces between points in mm, x to the right and y up. A closed one ends where it
/// begins, without saying that point twice.
struct Line {
  std::vector<glm::dvec2> points_mm;
  bool closed = false;
};

struct Drawing {
  std::vector<Line> lines;
  /// The file itself says that the axis is at x = 0, as a table of radii does.
  bool axis_at_zero = false;
};

/// Curves become chords no farther from them than this.
inline constexpr double kFlatMm = 1e-3;
/// No drawing of a pot needs more; what does is refused.
inline constexpr std::size_t kMostPoints = 1'000'000;
/// Lines that do not touch in the file: each is held against all others.
inline constexpr std::size_t kMostLines = 10'000;
inline constexpr std::size_t kMostBytes = 32u << 20;

/// Takes the format from the end of `name`:
/// .svg  all shapes that are shown, in CSS's units (1 px = 1/96 in), transforms and view box
/// obeyed; .dxf  lines, polylines with bulges, arcs, circles, ellipses and splines of the model, in
/// its
///       own units ($INSUNITS), mm where it names none;
/// .csv  radius and height in mm a line; an empty line begins a new line of the drawing, what
///       is after # and a first row of words are not read. The axis is at radius 0.
/// Errors read "NAME: what was expected, what was found", with the line where there is one.
Result<Drawing> read_drawing(std::string_view bytes, const std::string& name);

}  // namespace clay::importing
