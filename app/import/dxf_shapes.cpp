#include "app/import/dxf_shapes.hpp"

#include "app/import/curves.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

namespace clay::importing {
namespace {

constexpr long kClosed = 1;          // bit of a polyline's flags
constexpr long kMeshes = 16 | 64;    // bits of a POLYLINE that is a mesh
constexpr long kControlVertex = 16;  // bit of a VERTEX that only steers a curve
constexpr std::size_t kHighestDegree = 10;
constexpr double kMostTurns = 10.0;
constexpr double kFullTurn = 2.0 * std::numbers::pi;
constexpr double kSameAngle = 1e-9;  // [rad]
// A flatter arc is less than kFlatMm from the longest chord of a drawing, so it is straight.
constexpr double kLeastBulge = 1e-10;

tl::unexpected<Error> refusal(const DxfEntity& entity, const std::string& name,
                              const std::string& problem) {
  return failure(ErrorKind::bad_input,
                 fmt::format("{}:{}: {}: {}", name, entity.line, entity.type, problem));
}

/// Several numbers of an entity; those without a default must be there.
template <std::size_t N>
Result<std::array<double, N>> values(const DxfEntity& entity, const std::array<int, N>& codes,
                                     const std::string& name,
                                     const std::array<std::optional<double>, N>& otherwise = {}) {
  std::array<double, N> found{};
  for (std::size_t i = 0; i < N; ++i) {
    if (!otherwise[i] && entity.text(codes[i]).empty())
      return refusal(entity, name, fmt::format("expected a group {}, found none", codes[i]));
    const auto value = dxf_value(entity, codes[i], otherwise[i].value_or(0.0), name);
    if (!value) return tl::make_unexpected(value.error());
    found[i] = *value;
  }
  return found;
}

/// From one angle on, counterclockwise, to the next equal to the other. A full turn may be written
/// with few digits: 6.28319 is more than 2 pi.
double turn_between(double from_rad, double to_rad) {
  constexpr double kRounded = 1e-4;
  const double over = to_rad - from_rad - kFullTurn;
  if (over > 0.0 && over <= kRounded) return kFullTurn;
  const double turn = std::remainder(to_rad - from_rad, kFullTurn);
  return turn <= kSameAngle ? turn + kFullTurn : turn;
}

Line arc_line(const DxfPlacement& place, glm::dvec2 centre, glm::dvec2 u, glm::dvec2 v, double from,
              double turn) {
  u = place.along(u), v = place.along(v), centre = place.at(centre);
  Line line{{centre + std::cos(from) * u + std::sin(from) * v}, false};
  line.closed = std::abs(turn - kFullTurn) <= kSameAngle;
  // With the same chords in each quarter, a circle has its full size and is its own mirror image.
  const int parts = line.closed ? 4 : 1;
  const double step = turn / parts;
  for (int i = 0; i < parts; ++i)
    append_arc(line.points_mm, centre, u, v, from + i * step, from + (i + 1) * step);
  if (line.closed) line.points_mm.pop_back();
  return line;
}

Result<Line> straight(const DxfEntity& entity, const DxfPlacement& place, const std::string& name) {
  return values<4>(entity, {10, 20, 11, 21}, name).map([&](const std::array<double, 4>& p) {
    return Line{{place.at({p[0], p[1]}), place.at({p[2], p[3]})}, false};
  });
}

Result<Line> circle(const DxfEntity& entity, const DxfPlacement& place, const std::string& name) {
  return values<3>(entity, {10, 20, 40}, name).map([&](const std::array<double, 3>& p) {
    return arc_line(place, {p[0], p[1]}, {p[2], 0.0}, {0.0, p[2]}, 0.0, kFullTurn);
  });
}

Result<Line> arc(const DxfEntity& entity, const DxfPlacement& place, const std::string& name) {
  const auto found = values<5>(entity, {10, 20, 40, 50, 51}, name);
  if (!found) return tl::make_unexpected(found.error());
  const auto& [x, y, radius, from, to] = *found;
  if (std::max(std::abs(from), std::abs(to)) > 360.0 * kMostTurns)
    return refusal(entity, name,
                   fmt::format("expected angles of at most {:g} turns, found {:g} and {:g} degrees",
                               kMostTurns, from, to));
  const double start = from * std::numbers::pi / 180.0, end = to * std::numbers::pi / 180.0;
  return arc_line(place, {x, y}, {radius, 0.0}, {0.0, radius}, start, turn_between(start, end));
}

Result<Line> ellipse(const DxfEntity& entity, const DxfPlacement& plane, const DxfPlacement& place,
                     const std::string& name) {
  const auto found =
      values<7>(entity, {10, 20, 11, 21, 40, 41, 42}, name, {{{}, {}, {}, {}, {}, 0.0, kFullTurn}});
  if (!found) return tl::make_unexpected(found.error());
  const auto& [x, y, major_x, major_y, ratio, from, to] = *found;
  if (std::max(std::abs(from), std::abs(to)) > kFullTurn * kMostTurns)
    return refusal(entity, name,
                   fmt::format("expected parameters of at most {:g} turns, found {:g} and {:g} rad",
                               kMostTurns, from, to));
  // Unlike other round entities an ellipse is in world coordinates; seen from below it runs
  // clockwise.
  const double side = plane.turn[0][0];
  return arc_line(place, {x, y}, {major_x, major_y}, side * ratio * glm::dvec2{-major_y, major_x},
                  from, turn_between(from, to));
}

/// A vertex of a polyline: its place, and the bulge of the segment after it.
struct Vertex {
  glm::dvec2 point{0.0};
  double bulge = 0.0;
};

Result<Line> through(const std::vector<Vertex>& vertices, bool closed, const DxfPlacement& place,
                     PointLimits& limits, const DxfEntity& entity, const std::string& name) {
  Line line{{}, closed};
  for (std::size_t i = 0; i < vertices.size() + (closed ? 1 : 0); ++i) {
    const glm::dvec2 to = vertices[i % vertices.size()].point;
    const std::size_t before = line.points_mm.size();
    const double bulge = i == 0 ? 0.0 : vertices[i - 1].bulge;
    if (std::abs(bulge) > kLeastBulge) {
      const BulgeArc bent = bulge_arc(vertices[i - 1].point, to, bulge);
      append_arc(line.points_mm, place.at(bent.centre), place.along(bent.u), place.along(bent.v),
                 0.0, bent.turn);
      line.points_mm.back() = place.at(to);
    } else {
      line.points_mm.push_back(place.at(to));
    }
    const auto added = std::span(line.points_mm).subspan(before);
    if (const std::string problem = limits.problem_with(added); !problem.empty())
      return refusal(entity, name, problem);
  }
  if (closed) line.points_mm.pop_back();
  return line;
}

Result<std::vector<Vertex>> vertices_of(const DxfEntity& entity, const std::string& name) {
  std::vector<Vertex> vertices;
  for (const DxfGroup& group : entity.groups) {
    if (group.code != 10 && group.code != 20 && group.code != 42) continue;
    const auto value = dxf_number(group, name);
    if (!value) return tl::make_unexpected(value.error());
    if (group.code == 10) vertices.push_back({{*value, 0.0}, 0.0});
    if (group.code != 10 && vertices.empty())
      return refusal(entity, name, "expected a vertex to begin with group 10");
    if (group.code == 20) vertices.back().point.y = *value;
    if (group.code == 42) vertices.back().bulge = *value;
  }
  return vertices;
}

/// The VERTEX entities up to SEQEND; those of a mesh are taken too, and not used.
Result<std::vector<Vertex>> following_vertices(DxfGroups& groups, const std::string& name) {
  std::vector<Vertex> vertices;
  while (true) {
    const auto next = groups.peek();
    if (!next) return tl::make_unexpected(next.error());
    const bool end = next->value == "SEQEND";
    if (next->value != "VERTEX" && !end) return vertices;
    const auto entity = take_dxf_entity(groups, name);
    if (!entity) return tl::make_unexpected(entity.error());
    if (end) return vertices;
    const auto flags = dxf_count(*entity, 70, 0, name);
    const auto place = values<3>(*entity, {10, 20, 42}, name, {{{}, {}, 0.0}});
    if (!flags) return tl::make_unexpected(flags.error());
    if (!place) return tl::make_unexpected(place.error());
    if ((*flags & kControlVertex) == 0)
      vertices.push_back({{(*place)[0], (*place)[1]}, (*place)[2]});
  }
}

struct Spline {
  std::vector<glm::dvec3> control;
  std::vector<double> knots;
};

Result<Spline> spline_of(const DxfEntity& entity, const DxfPlacement& place,
                         const std::string& name) {
  Spline spline;
  std::vector<double> weights;  // before, between or after the points; in their order
  for (const DxfGroup& group : entity.groups) {
    if (group.code != 10 && group.code != 20 && group.code != 40 && group.code != 41) continue;
    const auto value = dxf_number(group, name);
    if (!value) return tl::make_unexpected(value.error());
    if (group.code == 40) spline.knots.push_back(*value);
    if (group.code == 10) spline.control.emplace_back(*value, 0.0, 0.0);
    if (group.code == 20 && !spline.control.empty()) spline.control.back().y = *value;
    if (group.code == 41) weights.push_back(*value);
  }
  if (!weights.empty() && weights.size() != spline.control.size())
    return refusal(entity, name,
                   fmt::format("expected a weight for each of {} control points or none, found {} "
                               "weights",
                               spline.control.size(), weights.size()));
  for (std::size_t i = 0; i < spline.control.size(); ++i) {
    glm::dvec3& p = spline.control[i];
    p = {place.at(glm::dvec2(p)), weights.empty() ? 1.0 : weights[i]};
  }
  return spline;
}

Result<Line> spline_line(const DxfEntity& entity, const DxfPlacement& place,
                         const std::string& name) {
  const auto degree = dxf_count(entity, 71, 3, name);
  const auto spline = spline_of(entity, place, name);
  if (!degree) return tl::make_unexpected(degree.error());
  if (!spline) return tl::make_unexpected(spline.error());
  const std::size_t order = static_cast<std::size_t>(std::clamp(*degree, 0L, 1000L)) + 1;
  const auto& [control, knots] = *spline;
  bool sound = order >= 2 && order <= kHighestDegree + 1 && control.size() >= order &&
               knots.size() == control.size() + order;
  for (std::size_t i = 1; sound && i < knots.size(); ++i) sound = knots[i] >= knots[i - 1];
  sound = sound && knots[order - 1] < knots[control.size()];  // between them is the curve
  for (const glm::dvec3& p : control) sound = sound && p.z > 0.0;
  if (control.empty() && !entity.text(11).empty())
    return refusal(entity, name,
                   "expected control points, found fit points alone; convert the spline to a "
                   "polyline, or save the drawing with its control points");
  if (!sound)
    return refusal(
        entity, name,
        fmt::format("expected splines of degree 1 to {} with a knot for each control point and "
                    "degree + 1 more, rising, and positive weights; found degree {}, {} control "
                    "points, {} knots",
                    kHighestDegree, *degree, control.size(), knots.size()));
  for (const glm::dvec3& p : control) {
    const glm::dvec2 point(p);
    if (const auto problem = PointLimits::out_of_bounds({&point, 1}); !problem.empty())
      return refusal(entity, name, problem);
  }
  return Line{spline_points(order - 1, control, knots), false};
}

Result<Line> polyline(const DxfEntity& entity, const std::vector<Vertex>& vertices, long flags,
                      const DxfPlacement& place, PointLimits& limits, const std::string& name) {
  if (vertices.empty()) return Line{};
  return through(vertices, (flags & kClosed) != 0, place, limits, entity, name);
}

}  // namespace

Result<double> dxf_value(const DxfEntity& entity, int code, double otherwise,
                         const std::string& name) {
  for (const DxfGroup& group : entity.groups)
    if (group.code == code) return dxf_number(group, name);
  return otherwise;
}

Result<long> dxf_count(const DxfEntity& entity, int code, long otherwise, const std::string& name) {
  for (const DxfGroup& group : entity.groups)
    if (group.code == code) return dxf_integer(group, name);
  return otherwise;
}

Result<DxfPlacement> dxf_plane(const DxfEntity& entity, const std::string& name) {
  const auto normal = values<3>(entity, {210, 220, 230}, name, {{0.0, 0.0, 1.0}});
  if (!normal) return tl::make_unexpected(normal.error());
  const auto& [x, y, z] = *normal;
  if (std::hypot(x, y) > 1e-6 * std::abs(z))
    return refusal(entity, name,
                   fmt::format("expected an entity in the plane of the drawing, found the "
                               "extrusion direction ({:g}, {:g}, {:g})",
                               x, y, z));
  DxfPlacement plane;
  if (z < 0.0) plane.turn[0][0] = -1.0;
  return plane;
}

Result<std::optional<Line>> dxf_line(const DxfEntity& entity, DxfGroups& groups,
                                     const DxfPlacement& placement, PointLimits& limits,
                                     const std::string& name) {
  const std::string_view type = entity.type;
  const bool in_plane = type == "ARC" || type == "CIRCLE" || type == "LWPOLYLINE" ||
                        type == "POLYLINE" || type == "ELLIPSE";
  if (!in_plane && type != "LINE" && type != "SPLINE") return std::nullopt;
  const auto plane = in_plane ? dxf_plane(entity, name) : Result<DxfPlacement>(DxfPlacement{});
  if (!plane) return tl::make_unexpected(plane.error());
  const DxfPlacement place = placement.after(*plane);
  const bool poly = type == "LWPOLYLINE" || type == "POLYLINE";
  Result<Line> line = Line{};
  if (poly) {
    const auto flags = dxf_count(entity, 70, 0, name);
    const auto vertices =
        type == "POLYLINE" ? following_vertices(groups, name) : vertices_of(entity, name);
    if (!flags) return tl::make_unexpected(flags.error());
    if (!vertices) return tl::make_unexpected(vertices.error());
    if (type == "POLYLINE" && (*flags & kMeshes) != 0) return std::nullopt;
    line = polyline(entity, *vertices, *flags, place, limits, name);
  } else {
    line = type == "LINE"      ? straight(entity, place, name)
           : type == "ARC"     ? arc(entity, place, name)
           : type == "CIRCLE"  ? circle(entity, place, name)
           : type == "ELLIPSE" ? ellipse(entity, *plane, placement, name)
                               : spline_line(entity, place, name);
  }
  if (!line) return tl::make_unexpected(line.error());
  if (poly) return std::move(*line);  // checked segment by segment
  if (const std::string problem = limits.problem_with(line->points_mm); !problem.empty())
    return refusal(entity, name, problem);
  return std::move(*line);
}

}  // namespace clay::importing
