#include "app/import/half_section.hpp"

#include "app/import/drawn_axis.hpp"
#include "app/import/joined_lines.hpp"
#include "app/import/level_lines.hpp"
#include "app/import/outline_faults.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <optional>
#include <tuple>
#include <utility>

namespace clay::importing {
namespace {

/// A straight segment of the outline that rises from `low` to `high`.
struct Edge {
  glm::dvec2 low, high;
  std::size_t line = 0;  ///< the outline that it is part of
  [[nodiscard]] double radius_at(double y) const {
    return low.x + (high.x - low.x) * ((y - low.y) / (high.y - low.y));
  }
};

/// The error for one of several lines whose two ends are not on the axis.
tl::unexpected<Error> open_line(const Line& line, const std::vector<Line>& lines,
                                const std::string& name) {
  const auto place = [](glm::dvec2 p) { return fmt::format("({:.3f}, {:.3f})", p.x, p.y); };
  const std::string expected = name + ": expected closed outlines, or a single open one, found ";
  const char* const unit = "mm from axis and foot";
  if (const auto gap = narrowest_gap(lines))
    return failure(
        ErrorKind::bad_input,
        fmt::format("{}a gap of {:.3f} mm between the ends at {} and {} {}; ends within {:g} mm of "
                    "each other are joined",
                    expected, gap->mm, place(gap->from), place(gap->to), unit, kSamePointMm));
  return failure(ErrorKind::bad_input,
                 fmt::format("{}{} lines of which one ends at {} and {} {}", expected, lines.size(),
                             place(line.points_mm.front()), place(line.points_mm.back()), unit));
}

/// Closes open lines where possible; the message names the others.
Result<void> close(std::vector<Line>& lines, const std::string& name) {
  for (Line& line : lines) {
    if (line.closed) continue;
    const bool on_axis =
        line.points_mm.front().x <= kSamePointMm && line.points_mm.back().x <= kSamePointMm;
    if (!on_axis && lines.size() > 1) return open_line(line, lines, name);
    const double last = line.points_mm.back().y, first = line.points_mm.front().y;
    line.points_mm.emplace_back(0.0, last);
    line.points_mm.emplace_back(0.0, first);
    line.closed = true;
  }
  return {};
}

/// Calls `use` with the ends of each piece that rises or falls beside the axis, x = 0, as far as it
/// is there. Level pieces do not bound clay sideways. `side`: right of the axis for 1; left for -1,
/// mirrored.
template <class Use>
void for_each_bound(const Line& line, double side, Use use) {
  for_each_piece(line, [&](glm::dvec2 a, glm::dvec2 b) {
    a.x *= side, b.x *= side;
    if (a.y == b.y || (a.x <= 0.0 && b.x <= 0.0)) return;
    const auto& [low, high] = a.y < b.y ? std::pair(a, b) : std::pair(b, a);
    const double crossing = low.y + (high.y - low.y) * (low.x / (low.x - high.x));
    if (a.x < 0.0) a = {0.0, crossing};
    if (b.x < 0.0) b = {0.0, crossing};
    if (a.y != b.y) use(a, b);
  });
}

/// The segments of closed lines right of the axis.
std::vector<Edge> edges_of(const std::vector<Line>& lines) {
  std::vector<Edge> edges;
  for (std::size_t index = 0; index < lines.size(); ++index)
    for_each_bound(lines[index], 1.0, [&](glm::dvec2 a, glm::dvec2 b) {
      if (a.y > b.y) std::swap(a, b);
      edges.push_back({a, b, index});
    });
  std::sort(edges.begin(), edges.end(),
            [](const Edge& a, const Edge& b) { return a.low.y < b.low.y; });
  return edges;
}

/// The volume of the solids of revolution of the area on one side of the axis [mm^3]: right for
/// `side` 1, left for -1.
double volume_beside(const std::vector<Line>& lines, double side) {
  double sum = 0.0;
  for (const Line& line : lines)
    for_each_bound(line, side, [&](glm::dvec2 a, glm::dvec2 b) {
      sum += (b.y - a.y) * (a.x * a.x + a.x * b.x + b.x * b.x) / 3.0;
    });
  return std::numbers::pi * std::abs(sum);
}

/// Half of a mirrored drawing is enough; other clay left of the axis is lost.
void note_left_side(const std::vector<Line>& lines, const std::string& name,
                    std::vector<std::string>& notes) {
  constexpr double kSame = 0.01;
  const double left = volume_beside(lines, -1.0), right = volume_beside(lines, 1.0);
  if (left < 1e-3 * right || std::abs(left - right) <= kSame * right) return;
  notes.push_back(fmt::format(
      "{}: the drawing left of the axis ({:.1f} cm3 as clay) differs from that right of it ({:.1f} "
      "cm3) and is not used; choose another axis if that is wrong",
      name, 1e-3 * left, 1e-3 * right));
}

std::vector<double> levels_of(const std::vector<Edge>& edges) {
  std::vector<double> levels;
  for (const Edge& edge : edges) {
    levels.push_back(edge.low.y);
    levels.push_back(edge.high.y);
  }
  std::sort(levels.begin(), levels.end());
  levels.erase(std::unique(levels.begin(), levels.end()), levels.end());
  return levels;
}

tl::unexpected<Error> crossing(double radius, double y, const std::string& name) {
  return failure(
      ErrorKind::bad_input,
      fmt::format("{}: {:.3f} mm from the axis and {:.3f} mm above the foot: expected an "
                  "outline that does not cross or touch itself, found one that does; an outline "
                  "with a gap is closed along the axis",
                  name, radius, y));
}

/// Level parts of one line must not run over each other.
Result<void> check_treads(const std::vector<Line>& lines, const std::string& name) {
  struct Tread {
    double y, from, to;
  };
  for (const Line& line : lines) {
    std::vector<Tread> treads;
    for (std::size_t i = 0; i < line.points_mm.size(); ++i) {
      const glm::dvec2 a = line.points_mm[i], b = line.points_mm[(i + 1) % line.points_mm.size()];
      const double from = std::max(0.0, std::min(a.x, b.x)), to = std::max(a.x, b.x);
      if (a.y == b.y && to > from) treads.push_back({a.y, from, to});
    }
    std::sort(treads.begin(), treads.end(), [](const Tread& a, const Tread& b) {
      return std::tie(a.y, a.from) < std::tie(b.y, b.from);
    });
    for (std::size_t i = 1; i < treads.size(); ++i) {
      const Tread &before = treads[i - 1], &tread = treads[i];
      if (tread.y == before.y && tread.from < std::min(before.to, tread.to) - kSamePointMm)
        return crossing(tread.from, tread.y, name);
    }
  }
  return {};
}

/// Clay above and below a level must have more than a circle in common.
Result<void> check_contacts(const std::vector<Slab>& slabs, const std::string& name) {
  for (std::size_t i = 1; i < slabs.size(); ++i) {
    const Slab &below = slabs[i - 1], &above = slabs[i];
    const double inner = std::max(below.inner_to_mm, above.inner_from_mm);
    if (inner >= std::min(below.outer_to_mm, above.outer_from_mm))
      return crossing(inner, above.from_mm, name);
  }
  return {};
}

/// More than two bounds at one height. `edges`: those that cross it, from the outside inward.
tl::unexpected<Error> side_by_side(double y, const std::vector<const Edge*>& edges,
                                   const std::string& name) {
  std::vector<double> radii;
  for (const Edge* edge : edges) radii.push_back(edge->radius_at(y));
  const bool one_line = std::all_of(edges.begin(), edges.end(), [&](const Edge* edge) {
    return edge->line == edges.front()->line;
  });
  const char* cause =
      !one_line ? "hide a frame or background, choose one layer, or unite shapes that overlap"
      : edges.size() % 2 == 1 ? "the floor rises towards the axis, beside a wall that begins lower"
                              : "the wall or the rim overhangs, or a groove is undercut";
  return failure(
      ErrorKind::bad_input,
      fmt::format("{}: {:.3f} mm above the foot: expected clay in one place, between a bore or the "
                  "axis and the outside, found it {}: {}",
                  name, y, clay_between(radii), cause));
}

/// No edge begins or ends between the two levels. `edges`: those that span both.
Result<Slab> slab_between(double from, double to, std::vector<const Edge*>& edges,
                          const std::string& name) {
  const double middle = 0.5 * (from + to);
  std::sort(edges.begin(), edges.end(), [&](const Edge* a, const Edge* b) {
    return a->radius_at(middle) > b->radius_at(middle);
  });
  if (edges.empty())
    return failure(ErrorKind::bad_input,
                   fmt::format("{}: expected clay around the axis at every height, found none from "
                               "{:.3f} to {:.3f} mm above the foot",
                               name, from, to));
  if (edges.size() > 2) return side_by_side(middle, edges, name);
  Slab slab{from, to, edges[0]->radius_at(from), edges[0]->radius_at(to), 0.0, 0.0};
  if (edges.size() == 1) return slab;
  slab.inner_from_mm = edges[1]->radius_at(from);
  slab.inner_to_mm = edges[1]->radius_at(to);
  // Negative where the two bounds cross.
  const double first = slab.outer_from_mm - slab.inner_from_mm;
  const double last = slab.outer_to_mm - slab.inner_to_mm;
  if (std::min(first, last) < -kSamePointMm) {
    const double part = std::clamp(first / (first - last), 0.0, 1.0);
    const double y = from + part * (to - from);
    return crossing(edges[0]->radius_at(y), y, name);
  }
  slab.inner_from_mm = std::min(slab.inner_from_mm, slab.outer_from_mm);
  slab.inner_to_mm = std::min(slab.inner_to_mm, slab.outer_to_mm);
  return slab;
}

Result<std::vector<Slab>> slabs_of(const std::vector<Edge>& edges, const std::string& name) {
  const std::vector<double> levels = levels_of(edges);
  std::vector<Slab> slabs;
  std::vector<const Edge*> spanning;
  std::size_t next = 0;
  for (std::size_t i = 0; i + 1 < levels.size(); ++i) {
    for (; next < edges.size() && edges[next].low.y <= levels[i]; ++next)
      spanning.push_back(&edges[next]);
    std::erase_if(spanning, [&](const Edge* edge) { return edge->high.y <= levels[i]; });
    const auto slab = slab_between(levels[i], levels[i + 1], spanning, name);
    if (!slab) return tl::make_unexpected(slab.error());
    slabs.push_back(*slab);
  }
  return slabs;
}

/// The slabs of the clay inside closed lines.
Result<std::vector<Slab>> checked_slabs(const std::vector<Line>& lines, const std::string& name) {
  auto slabs = slabs_of(edges_of(lines), name);
  if (!slabs) return slabs;
  for (const auto& checked : {check_treads(lines, name), check_contacts(*slabs, name)})
    if (!checked) return tl::make_unexpected(checked.error());
  if (slabs->empty())
    return failure(ErrorKind::bad_input, name +
                                             ": expected an outline with clay in it, found "
                                             "level lines only");
  return slabs;
}

/// Where the outline cannot be rings, a floor or rim that is level within the deviation of rings
/// becomes level: a drawing program rounds, and a hand does not draw a floor to 0.01 mm.
Result<std::vector<Slab>> slabs_within_tolerance(const std::vector<Line>& lines,
                                                 const std::string& name) {
  auto slabs = checked_slabs(lines, name);
  if (slabs) return slabs;
  std::vector<Line> leveled = lines;
  level(leveled, kLevelWithinMm);
  auto again = checked_slabs(leveled, name);
  return again ? again : slabs;
}

/// Moves the lines to the axis and the foot, and scales a drawing that the reader has not scaled.
/// Foot and height are those of the clay right of the axis, the only clay that is used.
Result<void> move_to_axis(Drawing& drawing, double axis_mm, std::optional<double> height_mm,
                          const std::string& name) {
  const Bounds bounds = bounds_of(drawing.lines);
  const double drawn_mm = bounds.high.y - bounds.low.y;
  if (!(drawn_mm > 0.0) || !(bounds.high.x > axis_mm))
    return failure(
        ErrorKind::bad_input,
        fmt::format("{}: expected an outline right of the axis at x = {:g} mm, found "
                    "one from x = {:g} to {:g}, {:g} mm high{}",
                    name, axis_mm / drawing.scale, bounds.low.x / drawing.scale,
                    bounds.high.x / drawing.scale, drawn_mm / drawing.scale,
                    drawn_mm > 0.0 ? "" : "; z is ignored: export the sketch in its own plane"));
  double low = 1e300, high = -1e300;
  for (Line& line : drawing.lines) {
    for (glm::dvec2& p : line.points_mm) p.x -= axis_mm;
    for_each_bound(line, 1.0, [&](glm::dvec2 a, glm::dvec2 b) {
      low = std::min({low, a.y, b.y});
      high = std::max({high, a.y, b.y});
    });
  }
  constexpr double kRounding = 1e-9;  // of where a line crosses the axis
  const bool none = !(low < high);    // refused later
  if (none || low - bounds.low.y <= kRounding * drawn_mm) low = bounds.low.y;
  if (none || bounds.high.y - high <= kRounding * drawn_mm) high = bounds.high.y;
  const double scale = height_mm.value_or(high - low) / (high - low);
  for (Line& line : drawing.lines)
    for (glm::dvec2& p : line.points_mm) p = scale * (p - glm::dvec2{0.0, low});
  return {};
}

/// The height of a drawing; its width if it has no height, as chords of a flat curve may not.
double size_of(const std::vector<Line>& lines) {
  const Bounds bounds = bounds_of(lines);
  const glm::dvec2 size = bounds.high - bounds.low;
  return size.y > 0.0 ? size.y : size.x;
}

Result<HalfSection> section_as_drawn(Drawing drawing, const HalfSectionSettings& settings,
                                     const std::string& name) {
  drawing.lines = joined(std::move(drawing.lines));
  if (drawing.lines.empty())
    return failure(ErrorKind::bad_input,
                   name + ": expected the outline of a pot, found only points in it");
  HalfSection section;
  if (auto placed = place_axis(section, drawing, settings, name); !placed)
    return tl::make_unexpected(placed.error());
  const double axis_mm = std::exchange(section.axis_mm, section.axis_mm / drawing.scale);
  if (drawing.lines.empty())
    return failure(ErrorKind::bad_input,
                   fmt::format("{}: expected an outline beside the axis, found only lines on the "
                               "axis at x = {:g} mm",
                               name, section.axis_mm));
  turn_to_the_right(drawing.lines, axis_mm);
  const auto with_hint = [&, drawn = drawing](Error error) {
    error.message += hint_about(drawn, section, settings.axis != AxisRule::by_itself);
    return tl::make_unexpected(std::move(error));
  };
  if (auto moved = move_to_axis(drawing, axis_mm, settings.height_mm, name); !moved)
    return tl::make_unexpected(moved.error());
  straighten(drawing.lines);
  if (auto closed = close(drawing.lines, name); !closed)
    return with_hint(std::move(closed.error()));
  section.notes.insert(section.notes.begin(), drawing.notes.begin(), drawing.notes.end());
  note_left_side(drawing.lines, name, section.notes);
  auto slabs = slabs_within_tolerance(drawing.lines, name);
  if (!slabs) return with_hint(std::move(slabs.error()));
  section.slabs = std::move(*slabs);
  section.height_mm = section.slabs.back().to_mm;
  return section;
}

/// Removes lines that are drawn twice, before and after lines are joined. Returns the number of
/// lines.
std::size_t without_repeats(std::vector<Line>& lines) {
  const std::size_t repeats = remove_repeats(lines);
  lines = joined(std::move(lines));
  return repeats + remove_repeats(lines);
}

}  // namespace

double HalfSection::volume_mm3() const noexcept {
  const auto squares = [](double a, double b) { return (a * a + a * b + b * b) / 3.0; };
  double sum = 0.0;
  for (const Slab& slab : slabs)
    sum += (slab.to_mm - slab.from_mm) * (squares(slab.outer_from_mm, slab.outer_to_mm) -
                                          squares(slab.inner_from_mm, slab.inner_to_mm));
  return std::numbers::pi * sum;
}

Result<HalfSection> half_section(Drawing drawing, const HalfSectionSettings& settings,
                                 const std::string& name) {
  if (!drawing.unit_stated && !settings.height_mm)
    drawing.notes.push_back(
        name +
        ": expected a page with a size in mm, cm or in, found none: 96 units are read as "
        "one inch; if the program that drew it counts otherwise, set the height of the pot");
  auto section = section_as_drawn(drawing, settings, name);
  // An outline that is drawn twice may enclose nothing, by the even-odd rule.
  if (section && section->volume_mm3() > 0.0) return section;
  const std::size_t repeats = without_repeats(drawing.lines);
  if (repeats == 0) return section;
  drawing.notes.push_back(fmt::format(
      "{}: expected every line once, found {} drawn again: each is read once", name, repeats));
  auto once = section_as_drawn(std::move(drawing), settings, name);
  return once ? once : section;
}

Result<HalfSection> read_half_section(std::string_view bytes, const std::string& name,
                                      const std::string& layer,
                                      const HalfSectionSettings& settings) {
  // Chords that are long for the pot may be lower than their curve: the second factor corrects it.
  constexpr int kMostReadings = 4;
  constexpr double kSameScale = 1e-3;
  auto drawing = read_drawing(bytes, name, layer);
  for (int i = 1; drawing && settings.height_mm && i < kMostReadings; ++i) {
    const double factor = *settings.height_mm / size_of(drawing->lines);
    const double scale = factor * drawing->scale;
    if (!std::isnormal(scale) || std::abs(factor - 1.0) <= kSameScale) break;
    drawing = read_drawing(bytes, name, layer, scale);
  }
  return std::move(drawing).and_then(
      [&](Drawing&& read) { return half_section(std::move(read), settings, name); });
}

}  // namespace clay::importing
