#include "app/import/half_section.hpp"

#include "app/import/joined_lines.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <glm/common.hpp>
#include <numbers>
#include <tuple>
#include <utility>

namespace clay::importing {
namespace {

/// A straight segment of the outline that rises from `low` to `high`.
struct Edge {
  glm::dvec2 low, high;
  [[nodiscard]] double radius_at(double y) const {
    return low.x + (high.x - low.x) * ((y - low.y) / (high.y - low.y));
  }
};

struct Bounds {
  glm::dvec2 low{1e300}, high{-1e300};
};

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

/// Whether every corner has a mirror image among the corners, in its cell or a neighbouring one: a
/// drawing of both halves.
bool mirrored(const std::vector<Line>& lines, double middle) {
  std::vector<Cell> cells, images;
  for (const Line& line : lines) {
    for (const glm::dvec2& p : line.points_mm) {
      cells.push_back(cell_of(p));
      images.push_back(cell_of({2.0 * middle - p.x, p.y}));
    }
  }
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
Result<std::optional<double>> take_axis_lines(std::vector<Line>& lines, std::optional<double> asked,
                                              const std::string& name) {
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
                    "{:g} and {:g} mm; --axis chooses the axis, --layer one layer of a drawing",
                    name, found.front(), found.back()));
  const double axis = asked.value_or(found.front());
  std::erase_if(lines, [&](const Line& line) {
    const auto x = upright(line);
    return x && std::abs(*x - axis) <= kSamePointMm;
  });
  return axis;
}

std::string ends_of(const Line& line) {
  const glm::dvec2 a = line.points_mm.front(), b = line.points_mm.back();
  return fmt::format("({:.3f}, {:.3f}) and ({:.3f}, {:.3f}) mm from foot and axis", a.x, a.y, b.x,
                     b.y);
}

/// Closes open lines where possible; the message names the others.
Result<void> close(std::vector<Line>& lines, const std::string& name) {
  for (Line& line : lines) {
    if (line.closed) continue;
    const bool on_axis =
        line.points_mm.front().x <= kSamePointMm && line.points_mm.back().x <= kSamePointMm;
    if (!on_axis && lines.size() > 1)
      return failure(ErrorKind::bad_input,
                     fmt::format("{}: expected closed outlines, or a single open one, found {} "
                                 "lines of which one ends at {}",
                                 name, lines.size(), ends_of(line)));
    const double last = line.points_mm.back().y, first = line.points_mm.front().y;
    line.points_mm.emplace_back(0.0, last);
    line.points_mm.emplace_back(0.0, first);
    line.closed = true;
  }
  return {};
}

/// The segments right of the axis, except horizontal ones, which do not bound clay sideways.
std::vector<Edge> edges_of(const std::vector<Line>& lines) {
  std::vector<Edge> edges;
  for (const Line& line : lines) {
    for (std::size_t i = 0; i < line.points_mm.size(); ++i) {
      glm::dvec2 a = line.points_mm[i], b = line.points_mm[(i + 1) % line.points_mm.size()];
      if (a.y > b.y) std::swap(a, b);
      if (a.y == b.y || (a.x <= 0.0 && b.x <= 0.0)) continue;
      const double crossing = a.y + (b.y - a.y) * (a.x / (a.x - b.x));
      if (a.x < 0.0) a = {0.0, crossing};
      if (b.x < 0.0) b = {0.0, crossing};
      if (a.y < b.y) edges.push_back({a, b});
    }
  }
  std::sort(edges.begin(), edges.end(),
            [](const Edge& a, const Edge& b) { return a.low.y < b.low.y; });
  return edges;
}

/// Of the solids of revolution of what lies on one side of the axis: right for `side` 1, left for
/// -1. [mm^3]
double volume_beside(const std::vector<Line>& lines, double side) {
  double sum = 0.0;
  for (const Line& line : lines)
    for (std::size_t i = 0; i < line.points_mm.size(); ++i) {
      glm::dvec2 a = line.points_mm[i], b = line.points_mm[(i + 1) % line.points_mm.size()];
      a.x *= side, b.x *= side;
      if (a.x <= 0.0 && b.x <= 0.0) continue;
      const double crossing = a.y + (b.y - a.y) * (a.x / (a.x - b.x));
      if (a.x < 0.0) a = {0.0, crossing};
      if (b.x < 0.0) b = {0.0, crossing};
      sum += (b.y - a.y) * (a.x * a.x + a.x * b.x + b.x * b.x) / 3.0;
    }
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
      "cm3) and is not used; --axis places the axis",
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

/// No edge begins or ends between the two levels. `edges`: those that span both.
Result<Slab> slab_between(double from, double to, std::vector<const Edge*>& edges,
                          const std::string& name) {
  const double middle = 0.5 * (from + to);
  std::sort(edges.begin(), edges.end(), [&](const Edge* a, const Edge* b) {
    return a->radius_at(middle) > b->radius_at(middle);
  });
  const auto refuse = [&](const char* expected, std::size_t found) {
    return failure(ErrorKind::bad_input,
                   fmt::format("{}: {:.3f} mm above the foot: expected {}, found {} bounds", name,
                               middle, expected, found));
  };
  if (edges.empty()) return refuse("clay at every height from foot to rim", 0);
  if (edges.size() > 2)
    return failure(
        ErrorKind::bad_input,
        fmt::format("{}: {:.3f} mm above the foot: expected clay in one place, between a "
                    "bore or the axis and the outside, found {} outlines side by side; "
                    "hide a frame or background, choose a layer with --layer, or unite "
                    "shapes that overlap",
                    name, middle, edges.size()));
  Slab slab{from, to, edges[0]->radius_at(from), edges[0]->radius_at(to), 0.0, 0.0};
  if (edges.size() == 1) return slab;
  slab.inner_from_mm = edges[1]->radius_at(from);
  slab.inner_to_mm = edges[1]->radius_at(to);
  // Negative where the two have changed places.
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

/// Gives one height to all points of nearly one height, and puts points near the axis on it. A
/// horizontal line that a program has turned or rounded is not quite level and would need very fine
/// rings; a line beside the axis would become a bore.
void straighten(std::vector<Line>& lines) {
  constexpr double kLevelMm = 1e-4;
  std::vector<double*> heights;
  for (Line& line : lines)
    for (glm::dvec2& p : line.points_mm) {
      heights.push_back(&p.y);
      if (std::abs(p.x) <= kLevelMm) p.x = 0.0;
    }
  std::sort(heights.begin(), heights.end(),
            [](const double* a, const double* b) { return *a < *b; });
  const double top = *heights.back();
  for (std::size_t i = 0; i < heights.size();) {
    const double low = *heights[i];
    const double same = top - low <= kLevelMm ? top : low;  // the whole height stays
    for (; i < heights.size() && *heights[i] - low <= kLevelMm; ++i) *heights[i] = same;
  }
}

/// Sets the axis of the section, and removes axis lines from the drawing.
Result<void> place_axis(HalfSection& section, Drawing& drawing, const HalfSectionSettings& settings,
                        const std::string& name) {
  const Bounds bounds = bounds_of(drawing.lines);
  const double middle = 0.5 * (bounds.low.x + bounds.high.x);
  section.axis =
      settings.axis == AxisRule::by_itself && drawing.axis_at_zero ? AxisRule::at : settings.axis;
  std::optional<double> asked;
  if (section.axis == AxisRule::at)
    asked = settings.axis == AxisRule::at ? settings.axis_mm : 0.0;
  else if (section.axis != AxisRule::by_itself)
    asked = section.axis == AxisRule::left ? bounds.low.x : middle;
  const auto line = take_axis_lines(drawing.lines, asked, name);
  if (!line) return tl::make_unexpected(line.error());
  if (section.axis == AxisRule::by_itself)
    section.axis = *line                             ? AxisRule::line
                   : mirrored(drawing.lines, middle) ? AxisRule::middle
                                                     : AxisRule::left;
  section.axis_mm = asked                              ? *asked
                    : section.axis == AxisRule::line   ? **line
                    : section.axis == AxisRule::middle ? middle
                                                       : bounds.low.x;
  return {};
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
  drawing.lines = joined(std::move(drawing.lines));
  HalfSection section;
  if (auto placed = place_axis(section, drawing, settings, name); !placed)
    return tl::make_unexpected(placed.error());
  const Bounds bounds = bounds_of(drawing.lines);
  const double drawn_mm = bounds.high.y - bounds.low.y;
  if (!(drawn_mm > 0.0) || !(bounds.high.x > section.axis_mm))
    return failure(ErrorKind::bad_input,
                   fmt::format("{}: expected an outline right of the axis at x = {:g} mm, found "
                               "one from x = {:g} to {:g}, {:g} mm high",
                               name, section.axis_mm, bounds.low.x, bounds.high.x, drawn_mm));
  const double scale = settings.height_mm.value_or(drawn_mm) / drawn_mm;
  for (Line& line : drawing.lines)
    for (glm::dvec2& p : line.points_mm)
      p = scale * (p - glm::dvec2{section.axis_mm, bounds.low.y});
  straighten(drawing.lines);
  if (auto closed = close(drawing.lines, name); !closed) return tl::make_unexpected(closed.error());
  section.notes = std::move(drawing.notes);
  note_left_side(drawing.lines, name, section.notes);
  auto slabs = slabs_of(edges_of(drawing.lines), name);
  if (!slabs) return tl::make_unexpected(slabs.error());
  for (const auto& checked : {check_treads(drawing.lines, name), check_contacts(*slabs, name)})
    if (!checked) return tl::make_unexpected(checked.error());
  if (slabs->empty())
    return failure(ErrorKind::bad_input, name +
                                             ": expected an outline with clay in it, found "
                                             "level lines only");
  section.slabs = std::move(*slabs);
  section.height_mm = section.slabs.back().to_mm;
  return section;
}

}  // namespace clay::importing
