#include "app/import/curves.hpp"
#include "app/import/readers.hpp"

#include <dxflib/dl_creationadapter.h>
#include <dxflib/dl_dxf.h>
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <exception>
#include <numbers>
#include <optional>
#include <span>
#include <sstream>
#include <stdexcept>

namespace clay::importing {
namespace {

constexpr int kClosed = 1;  // bit of a polyline's or spline's flags
constexpr unsigned kHighestDegree = 10;

/// Length in mm of a unit by its number in $INSUNITS; empty for units that are not used for pots.
std::optional<double> mm_of_unit(int unit) {
  switch (unit) {
    case 0:  // no unit given
    case 4:
      return 1.0;
    case 1:
      return 25.4;
    case 2:
      return 304.8;
    case 5:
      return 10.0;
    case 6:
      return 1000.0;
    default:
      return std::nullopt;
  }
}

double radians(double degrees) { return degrees * std::numbers::pi / 180.0; }

/// Collects what the library reports. Ignores blocks, which are parts to be inserted.
class Collector final : public DL_CreationAdapter {
 public:
  std::vector<Line> lines;  // in mm
  std::string problem;

  void addBlock(const DL_BlockData&) override { in_block_ = true; }
  void endBlock() override { in_block_ = false; }
  void setVariableInt(const std::string& key, int value, int) override {
    if (key != "$INSUNITS") return;
    if (const auto mm = mm_of_unit(value))
      unit_mm_ = *mm;
    else
      problem = fmt::format("$INSUNITS: expected mm, cm, m, inches or feet, found unit {}", value);
  }

  void addLine(const DL_LineData& line) override {
    add({{at(line.x1, line.y1), at(line.x2, line.y2)}, false});
  }
  void addArc(const DL_ArcData& arc) override {
    double turn = arc.angle2 - arc.angle1;
    if (turn <= 0.0) turn += 360.0;
    add_arc(at(arc.cx, arc.cy), at(arc.radius, 0.0), at(0.0, arc.radius), radians(arc.angle1),
            radians(turn));
  }
  void addCircle(const DL_CircleData& circle) override {
    add_arc(at(circle.cx, circle.cy), at(circle.radius, 0.0), at(0.0, circle.radius), 0.0,
            2.0 * std::numbers::pi);
  }
  void addEllipse(const DL_EllipseData& ellipse) override {
    double turn = ellipse.angle2 - ellipse.angle1;
    if (turn <= 0.0) turn += 2.0 * std::numbers::pi;
    const glm::dvec2 major = at(ellipse.mx, ellipse.my);
    add_arc(at(ellipse.cx, ellipse.cy), major, ellipse.ratio * glm::dvec2{-major.y, major.x},
            ellipse.angle1, turn);
  }

  void addPolyline(const DL_PolylineData& polyline) override {
    finish();
    polyline_ = {{}, (polyline.flags & kClosed) != 0};
    checked_ = 0;
  }
  void addVertex(const DL_VertexData& vertex) override {
    if (!polyline_) return;
    const glm::dvec2 point = at(vertex.x, vertex.y);
    if (polyline_->points_mm.empty())
      first_ = point;
    else
      append_bulge(polyline_->points_mm, last_, point, bulge_);
    if (polyline_->points_mm.empty()) polyline_->points_mm.push_back(point);
    check(polyline_->points_mm, checked_);
    checked_ = polyline_->points_mm.size();
    last_ = point;
    bulge_ = vertex.bulge;
  }

  void addSpline(const DL_SplineData& spline) override {
    finish();
    spline_.emplace(Spline{spline.degree, {}, {}});
  }
  void addControlPoint(const DL_ControlPointData& p) override {
    const glm::dvec2 point = at(p.x, p.y);
    refuse(PointLimits::out_of_bounds({&point, 1}));
    if (spline_) spline_->control.emplace_back(point, p.w);
  }
  void addKnot(const DL_KnotData& knot) override {
    if (spline_) spline_->knots.push_back(knot.k);
  }

  void endEntity() override { finish(); }
  void endSequence() override { finish(); }

  /// Completes the last entity: the library does not always report its end.
  void finish() {
    if (polyline_ && !polyline_->points_mm.empty()) {
      if (polyline_->closed) {
        append_bulge(polyline_->points_mm, last_, first_, bulge_);
        polyline_->points_mm.pop_back();
      }
      add(std::move(*polyline_), checked_);
    }
    polyline_.reset();
    if (spline_) add_spline(*spline_);
    spline_.reset();
  }

 private:
  struct Spline {
    std::size_t degree;
    std::vector<glm::dvec3> control;
    std::vector<double> knots;
  };

  [[nodiscard]] glm::dvec2 at(double x, double y) const { return unit_mm_ * glm::dvec2{x, y}; }

  /// `checked`: number of points already checked.
  void add(Line line, std::size_t checked = 0) {
    check(line.points_mm, checked);
    if (!in_block_) lines.push_back(std::move(line));
  }

  /// The library can be stopped only by an exception.
  void check(const std::vector<glm::dvec2>& points, std::size_t from) {
    refuse(limits_.problem_with(std::span(points).subspan(std::min(from, points.size()))));
  }
  void refuse(const std::string& found) {
    if (found.empty()) return;
    problem = found;
    throw std::runtime_error(found);
  }

  void add_arc(glm::dvec2 centre, glm::dvec2 u, glm::dvec2 v, double from, double turn) {
    Line line{{centre + std::cos(from) * u + std::sin(from) * v}, false};
    append_arc(line.points_mm, centre, u, v, from, from + turn);
    line.closed = std::abs(turn - 2.0 * std::numbers::pi) < 1e-9;
    if (line.closed) line.points_mm.pop_back();
    add(std::move(line));
  }

  void add_spline(const Spline& spline) {
    const bool whole = spline.degree >= 1 && spline.degree <= kHighestDegree &&
                       spline.control.size() > spline.degree &&
                       spline.knots.size() == spline.control.size() + spline.degree + 1;
    bool sound = whole;
    for (std::size_t i = 1; sound && i < spline.knots.size(); ++i)
      sound = spline.knots[i] >= spline.knots[i - 1];
    for (const glm::dvec3& p : spline.control) sound = sound && p.z > 0.0;
    if (!sound) {
      problem = fmt::format(
          "expected splines of degree 1 to {} with a knot for each control point and degree + 1 "
          "more, rising, and positive weights; found degree {}, {} control points, {} knots",
          kHighestDegree, spline.degree, spline.control.size(), spline.knots.size());
      return;
    }
    add({spline_points(spline.degree, spline.control, spline.knots), false});
  }

  double unit_mm_ = 1.0;
  bool in_block_ = false;
  PointLimits limits_;
  std::optional<Line> polyline_;
  std::size_t checked_ = 0;  ///< points of the polyline
  glm::dvec2 first_{0.0}, last_{0.0};
  double bulge_ = 0.0;
  std::optional<Spline> spline_;
};

}  // namespace

Result<Drawing> read_dxf(std::string_view bytes, const std::string& name) {
  Collector collector;
  try {
    std::istringstream stream{std::string(bytes)};
    DL_Dxf reader;
    reader.in(stream, &collector);
    collector.finish();
  } catch (const std::exception& error) {
    if (collector.problem.empty())
      return failure(ErrorKind::bad_input,
                     fmt::format("{}: expected a DXF drawing, found: {}", name, error.what()));
  }
  if (!collector.problem.empty())
    return failure(ErrorKind::bad_input, name + ": " + collector.problem);
  return Drawing{std::move(collector.lines), false};
}

}  // namespace clay::importing
