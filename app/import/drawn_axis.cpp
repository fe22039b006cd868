#include "app/import/drawn_axis.hpp"

#include "app/import/joined_lines.hpp"
#include "app/import/outline_faults.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <glm/common.hpp>
#include <optional>

namespace clay::importing {
namespace {

/// Whether the ends and the middle of every piece have a mirror image among them, in its cell or a
/// neighbouring one: a drawing of both halves. Without the middles, a half section that is open
/// towards its axis would be one.
bool mirrored(const std::vector<Line>& lines, double middle) {
  std::vector<Cell> cells, images;
  for_each_piece(lines, [&](glm::dvec2 a, glm::dvec2 b) {
    for (const glm::dvec2& p : {a, 0.5 * (a + b), b}) {
      cells.push_back(cell_of(p));
      images.push_back(cell_of({2.0 * middle - p.x, p.y}));
    }
  });
  std::sort(cells.begin(), cells.end());
  return std::all_of(images.begin(), images.end(), [&](const Cell& image) {
    for (const std::int64_t beside : {0, -1, 1}) {
      const Cell lowest{image.first + beside, image.second - 1};
      const auto near = std::lower_bound(cells.begin(), cells.end(), lowest);
      if (near != cells.end() && near->first == lowest.first && near->second <= image.second + 1)
        return true;
    }
    return false;
  });
}

/// A straight vertical line.
std::optional<double> upright(const Line& line) {
  if (line.closed) return std::nullopt;
  const glm::dvec2 first = line.points_mm.front();
  for (const glm::dvec2& p : line.points_mm)
    if (std::abs(p.x - first.x) > kSamePointMm) return std::nullopt;
  return first.x;
}

/// Removes axis lines, which are straight, vertical, and connected to no other line, and returns
/// where they are. `asked`: the axis, if it is given.
Result<std::optional<double>> take_axis_lines(Drawing& drawing, std::optional<double> asked,
                                              const std::string& name) {
  std::vector<Line>& lines = drawing.lines;
  std::vector<double> found;
  for (const Line& line : lines)
    if (const auto x = upright(line)) found.push_back(*x);
  if (found.empty() || lines.size() == 1) return std::nullopt;
  std::sort(found.begin(), found.end());
  // Among upright lines alone, the others are outlines.
  if (found.size() == lines.size()) found.resize(1);
  if (!asked && std::abs(found.front() - found.back()) > kSamePointMm)
    return failure(
        ErrorKind::bad_input,
        fmt::format("{}: expected one axis line, found unconnected vertical lines at x = "
                    "{:g} and {:g} mm; choose an axis, or one layer of the drawing",
                    name, found.front() / drawing.scale, found.back() / drawing.scale));
  const double axis = asked.value_or(found.front());
  std::erase_if(lines, [&](const Line& line) {
    const auto x = upright(line);
    return x && std::abs(*x - axis) <= kSamePointMm;
  });
  return axis;
}

/// No line runs along the vertical line, and no line begins or ends on it nearly level, as a foot
/// or a lid does at an axis.
bool only_a_corner_at(const std::vector<Line>& lines, double x_mm) {
  const auto level_at = [&](glm::dvec2 end, glm::dvec2 next) {
    return std::abs(end.x - x_mm) <= kSamePointMm &&
           std::abs(next.y - end.y) <= std::abs(next.x - end.x);
  };
  return !edge_along(lines, x_mm) && std::none_of(lines.begin(), lines.end(), [&](const Line& l) {
    const auto& p = l.points_mm;
    return !l.closed && p.size() > 1 &&
           (level_at(p[0], p[1]) || level_at(p.rbegin()[0], p.rbegin()[1]));
  });
}

/// Closed outlines with a straight edge at their right end and none at their left: the edge is the
/// axis, unless the drawing shows both halves.
bool drawn_left_of_its_edge(const std::vector<Line>& lines) {
  const Bounds bounds = bounds_of(lines);
  return std::all_of(lines.begin(), lines.end(), [](const Line& l) { return l.closed; }) &&
         only_a_corner_at(lines, bounds.low.x) && edge_along(lines, bounds.high.x) &&
         !nearly_mirrored(lines, 0.5 * (bounds.low.x + bounds.high.x));
}

/// A shape that is its own mirror image except for its corners: a half section with an additional
/// corner, or a drawing of both halves.
bool mirrored_but_for_corners(const std::vector<Line>& lines, double middle) {
  constexpr std::size_t kMostCorners = 20'000;  // limits the time to compare them
  std::size_t corners = 0;
  for (const Line& line : lines) corners += line.points_mm.size();
  return corners <= kMostCorners && mirrored_within(lines, middle, kSamePointMm);
}

/// Adds a note that the axis is doubtful: no rule but the last one, the left end, applied.
void note_doubt(HalfSection& section, const Drawing& drawing, double middle,
                const std::string& name) {
  if (only_a_corner_at(drawing.lines, section.axis_mm))
    section.notes.push_back(fmt::format(
        "{}: expected a straight edge of the outline along the axis, or a vertical line beside it, "
        "found only a corner at the left end, x = {:g} mm, which is used as the axis; choose "
        "another if it is wrong",
        name, section.axis_mm / drawing.scale));
  else if (mirrored_but_for_corners(drawing.lines, middle))
    section.notes.push_back(fmt::format(
        "{}: expected one half of a pot, or both with the same corners, found a shape that is "
        "symmetric about x = {:g} mm but for its corners; its left end, x = {:g} mm, is used as "
        "the axis; choose the middle if both halves are drawn",
        name, middle / drawing.scale, section.axis_mm / drawing.scale));
}

}  // namespace

Bounds bounds_of(const std::vector<Line>& lines) {
  Bounds bounds;
  for (const Line& line : lines) {
    for (const glm::dvec2& p : line.points_mm) {
      bounds.low = glm::min(bounds.low, p);
      bounds.high = glm::max(bounds.high, p);
    }
  }
  return bounds;
}

Result<void> place_axis(HalfSection& section, Drawing& drawing, const HalfSectionSettings& settings,
                        const std::string& name) {
  const Bounds bounds = bounds_of(drawing.lines);
  const double middle = 0.5 * (bounds.low.x + bounds.high.x);
  section.axis =
      settings.axis == AxisRule::by_itself && drawing.axis_at_zero ? AxisRule::at : settings.axis;
  std::optional<double> asked;
  if (section.axis == AxisRule::at)
    asked = settings.axis == AxisRule::at ? settings.axis_mm * drawing.scale : 0.0;
  else if (section.axis != AxisRule::by_itself)
    asked = section.axis == AxisRule::left    ? bounds.low.x
            : section.axis == AxisRule::right ? bounds.high.x
                                              : middle;
  const auto line = take_axis_lines(drawing, asked, name);
  if (!line) return tl::make_unexpected(line.error());
  if (section.axis == AxisRule::by_itself)
    section.axis = *line                                   ? AxisRule::line
                   : mirrored(drawing.lines, middle)       ? AxisRule::middle
                   : drawn_left_of_its_edge(drawing.lines) ? AxisRule::right
                                                           : AxisRule::left;
  section.axis_mm = asked                              ? *asked
                    : section.axis == AxisRule::line   ? **line
                    : section.axis == AxisRule::middle ? middle
                    : section.axis == AxisRule::right  ? bounds.high.x
                                                       : bounds.low.x;
  if (section.axis == AxisRule::left && settings.axis == AxisRule::by_itself)
    note_doubt(section, drawing, middle, name);
  return {};
}

void turn_to_the_right(std::vector<Line>& lines, double axis_mm) {
  const Bounds bounds = bounds_of(lines);
  if (!(bounds.high.x <= axis_mm + kSamePointMm) || !(bounds.low.x < axis_mm)) return;
  for (Line& line : lines)
    for (glm::dvec2& p : line.points_mm) p.x = 2.0 * axis_mm - p.x;
}

std::string hint_about(const Drawing& drawing, const HalfSection& section, bool chosen) {
  const Bounds bounds = bounds_of(drawing.lines);
  const double middle = 0.5 * (bounds.low.x + bounds.high.x);
  if (chosen || section.axis != AxisRule::left || !nearly_mirrored(drawing.lines, middle))
    return {};
  return fmt::format(
      "; the drawing is nearly symmetric about x = {:g} mm: with the axis in its middle, its right "
      "half is "
      "used",
      middle / drawing.scale);
}

}  // namespace clay::importing
