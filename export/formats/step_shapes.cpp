#include "export/formats/step_shapes.hpp"

#include <algorithm>
#include <cmath>
#include <string>
#include <tuple>
#include <utility>

namespace clay::solid::inline formats {
namespace {

constexpr double kSameMm = 1e-6;

bool same(double a, double b) { return std::abs(a - b) <= kSameMm; }

struct StepPoint {
  double x = 0.0, y = 0.0, z = 0.0;
  [[nodiscard]] StepLevel level() const { return {std::hypot(x, y), z}; }
  [[nodiscard]] bool is(const StepPoint& p) const {
    return same(x, p.x) && same(y, p.y) && same(z, p.z);
  }
};

StepPoint triple(const StepEntities& step, std::string_view ref, std::string_view keyword) {
  const StepValue& values = step.item(step.entity(ref, keyword, 2), 1);
  if (values.size != 3) bad_entity(ref, "three coordinates");
  return {step.number(values, 0), step.number(values, 1), step.number(values, 2)};
}
StepPoint point(const StepEntities& step, std::string_view ref) {
  return triple(step, ref, "CARTESIAN_POINT");
}
StepPoint direction(const StepEntities& step, std::string_view ref) {
  return triple(step, ref, "DIRECTION");
}

/// Height and direction of a frame on the axis.
std::pair<double, double> frame(const StepEntities& step, std::string_view ref) {
  const StepValue& placed = step.entity(ref, "AXIS2_PLACEMENT_3D", 4);
  const StepPoint origin = point(step, step.word(placed, 1));
  const StepPoint up = direction(step, step.word(placed, 2));
  const StepPoint across = direction(step, step.word(placed, 3));
  if (!same(origin.x, 0.0) || !same(origin.y, 0.0) ||
      !up.is({0.0, 0.0, std::copysign(1.0, up.z)}) || !across.is({1.0, 0.0, 0.0}))
    bad_entity(ref, "a frame on the axis");
  return {origin.z, up.z};
}

using Ends = std::array<StepPoint, 2>;

/// The circle of an edge of half a turn.
StepLevel half_circle(const StepEntities& step, std::string_view ref, const StepValue& circle,
                      const Ends& ends) {
  const auto [z, up] = frame(step, step.word(circle, 1));
  const StepLevel level{step.number(circle, 2), z};
  if (up < 0.0 || !level.is(ends[0].level()) || !level.is(ends[1].level()) ||
      !same(ends[0].x, -ends[1].x) || !same(ends[0].y, 0.0))
    bad_entity(ref, "half a circle from one of its vertices to the other");
  return level;
}

void check_line(const StepEntities& step, std::string_view ref, const StepValue& line,
                const Ends& ends) {
  const StepPoint from = point(step, step.word(line, 1));
  const StepValue& vector = step.entity(step.word(line, 2), "VECTOR", 3);
  const StepPoint way = direction(step, step.word(vector, 1));
  for (const StepPoint& end : ends) {
    const double along = (end.x - from.x) * way.x + (end.z - from.z) * way.z;
    if (!end.is({from.x + along * way.x, from.y + along * way.y, from.z + along * way.z}))
      bad_entity(ref, "both vertices on its line");
  }
}

/// The knots of a cubic: they ascend, and count once between the ends, which count fourfold.
std::vector<double> cubic_knots(const StepEntities& step, std::string_view ref,
                                std::string_view degree, const StepValue& multiplicities,
                                const StepValue& knots, std::size_t points) {
  if (degree != "3") bad_entity(ref, "degree 3");
  if (knots.size < 2 || points != knots.size + 2)
    bad_entity(ref, "two more control points than knots");
  std::vector<double> read;
  read.reserve(knots.size);
  for (std::size_t i = 0; i < knots.size; ++i) {
    const double knot = step.number(knots, i), count = i % (knots.size - 1) == 0 ? 4.0 : 1.0;
    if (multiplicities.size != knots.size || step.number(multiplicities, i) != count)
      bad_entity(ref, "knots that count once, and ends that count fourfold");
    if (i > 0 && !(knot > read.back())) bad_entity(ref, "knots in ascending order");
    read.push_back(knot);
  }
  return read;
}

/// Levels and knots of a curve.
void read_spline(const StepEntities& step, std::string_view ref, std::string_view curve,
                 const Ends& ends, StepEdge& edge) {
  const StepValue& spline = step.entity(curve, "B_SPLINE_CURVE_WITH_KNOTS", 9);
  const auto control = step.list(spline, 2);
  if (control.empty()) bad_entity(ref, "control points of its curve");
  if (!point(step, control.front().word).is(ends[0]) ||
      !point(step, control.back().word).is(ends[1]))
    bad_entity(ref, "a curve from one vertex to the other");
  edge.knots = cubic_knots(step, curve, step.word(spline, 1), step.item(spline, 6),
                           step.item(spline, 7), control.size());
  edge.levels.reserve(control.size());
  for (const StepValue& p : control) edge.levels.push_back(point(step, p.word).level());
}

constexpr std::array<double, 4> kRowWeights{3, 1, 1, 3};

/// Each row of control points must make half a circle of its last one.
ProfilePoint row_point(const StepEntities& step, std::string_view ref, const StepValue& row,
                       const StepValue& weights) {
  constexpr std::array<double, 4> kAcross{-1, -1, 1, 1}, kAside{0, 2, 2, 0};
  if (row.size != kRowWeights.size()) bad_entity(ref, "four points in each row");
  const StepPoint last = point(step, step.word(row, 3));
  for (std::size_t k = 0; k < kRowWeights.size(); ++k)
    if (step.number(weights, k) != kRowWeights[k] ||
        !point(step, step.word(row, k)).is({kAcross[k] * last.x, kAside[k] * last.x, last.z}))
      bad_entity(ref, "half a circle of every control point");
  return {std::abs(last.x), last.z};
}

WallCurve wall_curve(const StepEntities& step, std::string_view ref) {
  const StepValue& surface = step.part(ref, "B_SPLINE_SURFACE");
  const StepValue& knots = step.part(ref, "B_SPLINE_SURFACE_WITH_KNOTS");
  const auto weights = step.list(step.part(ref, "RATIONAL_B_SPLINE_SURFACE"), 0);
  const auto rows = step.list(surface, 2);
  if (rows.size() != weights.size()) bad_entity(ref, "a weight for each point");
  WallCurve curve;
  curve.knots = cubic_knots(step, ref, step.word(surface, 0), step.item(knots, 0),
                            step.item(knots, 2), rows.size());
  (void)cubic_knots(step, ref, step.word(surface, 1), step.item(knots, 1), step.item(knots, 3),
                    kRowWeights.size());
  for (std::size_t i = 0; i < rows.size(); ++i)
    curve.control.push_back(row_point(step, ref, rows[i], weights[i]));
  return curve;
}

}  // namespace

bool StepLevel::is(const StepLevel& other) const noexcept {
  return same(rho, other.rho) && same(z, other.z);
}

StepLevel StepSurface::end(bool last) const noexcept {
  const ProfilePoint& p = last ? curve->control.back() : curve->control.front();
  return {p.rho, p.y};
}

bool StepSurface::has(const StepEdge& edge) const noexcept {
  if (curve && edge.circle) return edge.levels[0].is(end(false)) || edge.levels[0].is(end(true));
  if (curve)
    return edge.knots == curve->knots &&
           std::ranges::equal(edge.levels, curve->control,
                              [](const StepLevel& a, const ProfilePoint& b) {
                                return a.is({b.rho, b.y});
                              });
  return std::ranges::all_of(edge.levels, [&](const StepLevel& p) {
    return plane ? same(p.z, at.z) : same(p.rho, at.rho + slope * up * (p.z - at.z));
  });
}

StepEdge step_edge(const StepEntities& step, std::string_view ref) {
  const StepValue& found = step.entity(ref, "EDGE_CURVE", 5);
  StepEdge edge{{step.word(found, 1), step.word(found, 2)}, false, {}, {}};
  Ends ends;
  for (std::size_t i = 0; i < 2; ++i)
    ends[i] = point(step, step.word(step.entity(edge.vertices[i], "VERTEX_POINT", 2), 1));
  if (!step.flag(found, 4)) bad_entity(ref, "the sense of its curve");
  const std::string_view curve = step.word(found, 3);
  const StepValue& shape = step.entity(curve);
  edge.circle = shape.word == "CIRCLE";
  if (edge.circle) {
    edge.levels = {half_circle(step, ref, shape, ends)};
  } else if (shape.word == "LINE") {
    check_line(step, ref, shape, ends);
    edge.levels = {ends[0].level(), ends[1].level()};
  } else {
    read_spline(step, ref, curve, ends, edge);
  }
  return edge;
}

StepSurface step_surface(const StepEntities& step, std::string_view ref) {
  const StepValue& shape = step.entity(ref);
  StepSurface surface;
  if (shape.word.empty()) {
    surface.curve = wall_curve(step, ref);
    return surface;
  }
  surface.plane = shape.word == "PLANE";
  const bool cone = shape.word == "CONICAL_SURFACE";
  if (!surface.plane && !cone && shape.word != "CYLINDRICAL_SURFACE")
    bad_entity(ref, std::string("a known surface, found ").append(shape.word));
  std::tie(surface.at.z, surface.up) = frame(step, step.word(shape, 1));
  if (!surface.plane) surface.at.rho = step.number(shape, 2);
  if (cone) surface.slope = std::tan(step.number(shape, 3));
  return surface;
}

}  // namespace clay::solid::inline formats
