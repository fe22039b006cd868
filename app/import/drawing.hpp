#pragma once
// A drawing of a pot: lines in the plane, from any file format.

#include "claystack/core/result.hpp"

#include <cstddef>
#include <glm/vec2.hpp>
#include <string>
#include <string_view>
#include <vector>

namespace clay::importing {

/// A polyline of points in mm, x to the right and y up. A closed one does not repeat its first
/// point.
struct Line {
  std::vector<glm::dvec2> points_mm;
  bool closed = false;
};

/// Calls `use` with the ends of each piece; of an open line, without the one that would close it.
template <class Use>
void for_each_piece(const Line& line, Use use) {
  const std::size_t count = line.points_mm.size();
  for (std::size_t i = 0; i + (line.closed ? 0 : 1) < count; ++i)
    use(line.points_mm[i], line.points_mm[(i + 1) % count]);
}
template <class Use>
void for_each_piece(const std::vector<Line>& lines, Use use) {
  for (const Line& line : lines) for_each_piece(line, use);
}

struct Drawing {
  std::vector<Line> lines;
  /// The file defines the axis at x = 0, as a table of radii does.
  bool axis_at_zero = false;
  std::vector<std::string> notes{};  ///< the parts that a reader left out, each for a warning
  double scale = 1.0;                ///< of the points, from the lengths in the file
  bool unit_stated = true;           ///< false: its lengths are in mm by convention only
};

/// Maximum distance of chords from their curves, after scaling.
inline constexpr double kFlatMm = 1e-3;
/// Far above the needs of a pot; larger drawings are refused.
inline constexpr std::size_t kMostPoints = 1'000'000;
inline constexpr std::size_t kMostLines = 200'000;
inline constexpr std::size_t kMostBytes = 32u << 20;

/// Selects the format by the extension of `name`:
/// - .svg: all visible shapes, in CSS units (1 px = 1/96 in), with transforms, view boxes, uses of
///   symbols, and style sheets as far as they hide shapes;
/// - .dxf: lines, polylines with bulges, arcs, circles, ellipses and splines of the model, with
///   inserted blocks, in its units ($INSUNITS), by default mm. Layers that are frozen, off, not
///   plotted or for construction (for_construction) are ignored;
/// - .csv: radius and height in mm per row, or as a first row of names states (csv_columns); an
///   empty row, also one of empty cells, begins a new line of the drawing; text after # is ignored.
///   The axis is at radius 0.
/// For the name "-", standard input, the first bytes select it.
/// `layer`: the only layer to read, by its name (SVG: label or id); empty: all that are shown.
/// `scale`: multiplies all lengths, before curves become chords.
/// Errors read "NAME: what was expected, what was found", with the line if there is one.
Result<Drawing> read_drawing(std::string_view bytes, const std::string& name,
                             const std::string& layer = {}, double scale = 1.0);

}  // namespace clay::importing
