// Judges a STEP file of this program by its text alone: topology, incidence, orientation, volume.

#include "core/number_parsing.hpp"
#include "export/formats/step.hpp"
#include "export/formats/step_text.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <numbers>
#include <optional>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

namespace clay::solid::inline formats {
namespace {

constexpr double kSameMm = 1e-6;

bool same(double a, double b) { return std::abs(a - b) <= kSameMm; }

/// A fault of an entity; never leaves this file.
struct BadStep {
  std::string what;
};

/// A circle around the axis, or a point of a meridian: distance from the axis and height.
struct Level {
  double rho = 0.0, z = 0.0;
  [[nodiscard]] bool is(const Level& other) const {
    return same(rho, other.rho) && same(z, other.z);
  }
};

struct StepPoint {
  double x = 0.0, y = 0.0, z = 0.0;
  [[nodiscard]] Level level() const { return {std::hypot(x, y), z}; }
  [[nodiscard]] bool is(const StepPoint& p) const {
    return same(x, p.x) && same(y, p.y) && same(z, p.z);
  }
};

struct StepEdge {
  std::array<std::string, 2> vertices;
  bool circle = false;
  std::vector<Level> levels;  ///< the circle; the ends of a line; the control points of a curve
};

/// A surface around the axis.
struct Surface {
  bool plane = false;
  double up = 1.0;  ///< direction of the normal of a plane, and of the axis of a cone
  Level at;         ///< height of a plane; a circle of a cone or cylinder
  double slope = 0.0;
  std::optional<WallCurve> curve;
  [[nodiscard]] bool has(const Level& level) const {
    if (plane) return same(level.z, at.z);
    return same(level.rho, at.rho + slope * up * (level.z - at.z));
  }
};

class StepJudge {
 public:
  explicit StepJudge(const StepEntities& entities) : entities_(entities) {}

  StepSolid run() {
    for (const auto& [ref, entity] : entities_)
      if (entity.word == "ADVANCED_BREP_SHAPE_REPRESENTATION")
        for (const StepValue& item : entity.items.at(1).items) judge_item(item.word);
    if (solid_.bodies == 0) throw BadStep{"expected a solid, found none"};
    return solid_;
  }

 private:
  const StepValue& entity(const std::string& ref) const {
    const auto found = entities_.find(ref);
    if (found == entities_.end()) throw BadStep{ref + ": expected an entity, found none"};
    return found->second;
  }
  const StepValue& entity(const std::string& ref, std::string_view keyword,
                          std::size_t items) const {
    const StepValue& found = entity(ref);
    if (found.word != keyword || found.items.size() != items)
      throw BadStep{ref + ": expected " + std::string(keyword) + ", found " + found.word};
    return found;
  }
  static double number(const StepValue& value) {
    double result = 0.0;
    const char* end = value.word.data() + value.word.size();
    if (from_chars(value.word.data(), end, result).ptr != end || value.word.empty())
      throw BadStep{"expected a number, found " + value.word};
    return result;
  }
  static bool flag(const StepValue& value) {
    if (value.word != ".T." && value.word != ".F.")
      throw BadStep{"expected .T. or .F., found " + value.word};
    return value.word == ".T.";
  }

  StepPoint triple(const std::string& ref, std::string_view keyword) const {
    const auto& c = entity(ref, keyword, 2).items[1].items;
    if (c.size() != 3) throw BadStep{ref + ": expected three coordinates"};
    return {number(c[0]), number(c[1]), number(c[2])};
  }
  StepPoint point(const std::string& ref) const { return triple(ref, "CARTESIAN_POINT"); }
  StepPoint vertex(const std::string& ref) const {
    return point(entity(ref, "VERTEX_POINT", 2).items[1].word);
  }

  /// Height and direction of a frame on the axis.
  std::pair<double, double> frame(const std::string& ref) const {
    const StepValue& placed = entity(ref, "AXIS2_PLACEMENT_3D", 4);
    const StepPoint origin = point(placed.items[1].word);
    const StepPoint up = triple(placed.items[2].word, "DIRECTION");
    if (!same(origin.x, 0.0) || !same(origin.y, 0.0) || !same(std::abs(up.z), 1.0))
      throw BadStep{ref + ": expected a frame on the axis"};
    return {origin.z, up.z};
  }

  StepEdge edge(const std::string& ref) const {
    const StepValue& found = entity(ref, "EDGE_CURVE", 5);
    StepEdge edge{{found.items[1].word, found.items[2].word}, false, {}};
    const std::string& curve = found.items[3].word;
    const std::array<StepPoint, 2> ends{vertex(edge.vertices[0]), vertex(edge.vertices[1])};
    const StepValue& shape = entity(curve);
    if (!flag(found.items[4])) throw BadStep{ref + ": expected the sense of its curve"};
    if (shape.word == "CIRCLE") {
      edge.circle = true;
      const auto [z, up] = frame(shape.items.at(1).word);
      edge.levels = {{number(shape.items.at(2)), z}};
      if (up < 0.0 || !edge.levels[0].is(ends[0].level()) || !edge.levels[0].is(ends[1].level()) ||
          !same(ends[0].x, -ends[1].x) || !same(ends[0].y, 0.0))
        throw BadStep{ref + ": expected half a circle from one of its vertices to the other"};
    } else if (shape.word == "LINE") {
      edge.levels = {ends[0].level(), ends[1].level()};
      check_line(ref, shape, ends);
    } else {
      const StepValue& spline = entity(curve, "B_SPLINE_CURVE_WITH_KNOTS", 9);
      const auto& control = spline.items[2].items;
      if (control.empty()) throw BadStep{ref + ": expected control points of its curve"};
      for (const StepValue& p : control) edge.levels.push_back(point(p.word).level());
      if (!point(control.front().word).is(ends[0]) || !point(control.back().word).is(ends[1]))
        throw BadStep{ref + ": expected a curve from one vertex to the other"};
    }
    return edge;
  }

  void check_line(const std::string& ref, const StepValue& line,
                  const std::array<StepPoint, 2>& ends) const {
    const StepPoint from = point(line.items.at(1).word);
    const StepValue& vector = entity(line.items.at(2).word, "VECTOR", 3);
    const StepPoint way = triple(vector.items[1].word, "DIRECTION");
    for (const StepPoint& end : ends) {
      const double along = (end.x - from.x) * way.x + (end.z - from.z) * way.z;
      if (!end.is({from.x + along * way.x, from.y + along * way.y, from.z + along * way.z}))
        throw BadStep{ref + ": expected both vertices on its line"};
    }
  }

  Surface surface(const std::string& ref) const {
    const StepValue& shape = entity(ref);
    Surface surface;
    if (shape.word.empty()) return spline_surface(ref, shape);
    const auto [z, up] = frame(shape.items.at(1).word);
    surface.up = up;
    surface.at.z = z;
    surface.plane = shape.word == "PLANE";
    if (surface.plane) return surface;
    surface.at.rho = number(shape.items.at(2));
    if (shape.word == "CONICAL_SURFACE")
      surface.slope = std::tan(number(shape.items.at(3)));
    else if (shape.word != "CYLINDRICAL_SURFACE")
      throw BadStep{ref + ": expected a known surface, found " + shape.word};
    return surface;
  }

  static const StepValue& part(const std::string& ref, const StepValue& complex,
                               std::string_view keyword) {
    for (const StepValue& value : complex.items)
      if (value.word == keyword) return value;
    throw BadStep{ref + ": expected " + std::string(keyword)};
  }

  /// Each row of control points must make half a circle of its last one.
  Surface spline_surface(const std::string& ref, const StepValue& shape) const {
    const auto& rows = part(ref, shape, "B_SPLINE_SURFACE").items.at(2).items;
    const auto& weights = part(ref, shape, "RATIONAL_B_SPLINE_SURFACE").items.at(0).items;
    constexpr std::array<double, 4> kAcross{-1, -1, 1, 1}, kAside{0, 2, 2, 0}, kWeight{3, 1, 1, 3};
    Surface surface;
    surface.curve.emplace();
    if (rows.size() != weights.size()) throw BadStep{ref + ": expected a weight for each point"};
    for (const StepValue& knot : part(ref, shape, "B_SPLINE_SURFACE_WITH_KNOTS").items.at(2).items)
      surface.curve->knots.push_back(number(knot));
    for (std::size_t i = 0; i < rows.size(); ++i) {
      const auto& row = rows[i].items;
      if (row.size() != 4) throw BadStep{ref + ": expected four points in each row"};
      const StepPoint last = point(row[3].word);
      surface.curve->control.push_back({std::abs(last.x), last.z});
      for (std::size_t k = 0; k < row.size(); ++k)
        if (number(weights[i].items.at(k)) != kWeight[k] ||
            !point(row[k].word).is({kAcross[k] * last.x, kAside[k] * last.x, last.z}))
          throw BadStep{ref + ": expected half a circle of every control point"};
    }
    if (surface.curve->control.size() != surface.curve->knots.size() + 2)
      throw BadStep{ref + ": expected two more control points than knots"};
    return surface;
  }

  void judge_item(const std::string& ref) {
    const StepValue& item = entity(ref);
    if (item.word == "AXIS2_PLACEMENT_3D") return;
    if (item.word != "MANIFOLD_SOLID_BREP" && item.word != "BREP_WITH_VOIDS")
      throw BadStep{ref + ": expected a solid, found " + item.word};
    ++solid_.bodies;
    const double before = solid_.volume_mm3;
    judge_shell(item.items.at(1).word);
    if (!(solid_.volume_mm3 > before)) throw BadStep{ref + ": expected normals out of the solid"};
    if (item.items.size() < 3) return;
    for (const StepValue& hole : item.items[2].items) {
      const StepValue& oriented = entity(hole.word, "ORIENTED_CLOSED_SHELL", 4);
      if (!flag(oriented.items[3])) throw BadStep{hole.word + ": expected the sense of its shell"};
      judge_shell(oriented.items[2].word);
    }
  }

  /// Closed and oriented: every edge is used twice, in opposite directions.
  void judge_shell(const std::string& ref) {
    std::map<std::string, std::pair<int, int>> uses;
    for (const StepValue& face : entity(ref, "CLOSED_SHELL", 2).items[1].items) {
      ++solid_.faces;
      judge_face(face.word, uses);
    }
    for (const auto& [edge, use] : uses)
      if (use != std::pair(1, 1))
        throw BadStep{edge + ": expected two faces in opposite directions, found " +
                      std::to_string(use.first) + " and " + std::to_string(use.second)};
    solid_.edges += uses.size();
  }

  /// An edge of a face, and whether the face uses it in its own direction.
  struct Use {
    StepEdge edge;
    bool forward = true;
  };

  std::vector<Use> loop(const std::string& ref,
                        std::map<std::string, std::pair<int, int>>& uses) const {
    std::vector<Use> edges;
    for (const StepValue& item : entity(ref, "EDGE_LOOP", 2).items[1].items) {
      const StepValue& oriented = entity(item.word, "ORIENTED_EDGE", 5);
      const bool forward = flag(oriented.items[4]);
      edges.push_back({edge(oriented.items[3].word), forward});
      auto& [ahead, back] = uses[oriented.items[3].word];
      ++(forward ? ahead : back);
    }
    for (std::size_t i = 0; i < edges.size(); ++i) {
      const Use &a = edges[i], &b = edges[(i + 1) % edges.size()];
      if (a.edge.vertices[a.forward ? 1 : 0] != b.edge.vertices[b.forward ? 0 : 1])
        throw BadStep{ref + ": expected edges that follow each other"};
    }
    return edges;
  }

  void judge_face(const std::string& ref, std::map<std::string, std::pair<int, int>>& uses) {
    const StepValue& face = entity(ref, "ADVANCED_FACE", 4);
    const Surface on = surface(face.items[2].word);
    const double sense = flag(face.items[3]) ? 1.0 : -1.0;
    std::vector<Use> circles;
    for (const StepValue& bound : face.items[1].items) {
      const StepValue& found = entity(bound.word);
      if (!flag(found.items.at(2))) throw BadStep{bound.word + ": expected the sense of its loop"};
      const std::size_t before = circles.size();
      for (Use& use : loop(found.items.at(1).word, uses)) {
        check_on_surface(ref, on, use.edge);
        if (use.edge.circle) circles.push_back(std::move(use));
      }
      if (!on.plane) continue;
      if (circles.size() == before) throw BadStep{bound.word + ": expected circles in its loop"};
      check_turn(ref, circles.back(), found.word == "FACE_OUTER_BOUND", sense * on.up);
    }
    if (on.plane) return;
    if (circles.size() != 2) throw BadStep{ref + ": expected two circles"};
    const bool ordered = on.curve ? circles[0].edge.levels[0].is(end_of(*on.curve, false))
                                  : circles[0].edge.levels[0].z < circles[1].edge.levels[0].z;
    const Use &low = circles[ordered ? 0 : 1], &high = circles[ordered ? 1 : 0];
    if (low.forward != (sense > 0.0) || high.forward == low.forward)
      throw BadStep{ref + ": expected edges counterclockwise around its normal"};
    solid_.volume_mm3 += sense * half_volume(on, low.edge.levels[0], high.edge.levels[0]);
  }

  /// Circles of a plane: the outer one counterclockwise around the normal, holes the other way.
  static void check_turn(const std::string& ref, const Use& circle, bool outer, double up) {
    if (circle.forward != (outer == (up > 0.0)))
      throw BadStep{ref + ": expected bounds counterclockwise around its normal"};
  }

  static Level end_of(const WallCurve& curve, bool last) {
    const ProfilePoint& p = last ? curve.control.back() : curve.control.front();
    return {p.rho, p.y};
  }

  static void check_on_surface(const std::string& ref, const Surface& surface,
                               const StepEdge& edge) {
    const bool on = [&] {
      if (!surface.curve)
        return std::ranges::all_of(edge.levels, [&](const Level& p) { return surface.has(p); });
      if (edge.circle)
        return edge.levels[0].is(end_of(*surface.curve, false)) ||
               edge.levels[0].is(end_of(*surface.curve, true));
      return std::ranges::equal(edge.levels, surface.curve->control,
                                [](const Level& a, const ProfilePoint& b) {
                                  return a.is({b.rho, b.y});
                                });
    }();
    if (!on) throw BadStep{ref + ": expected its edges on its surface"};
  }

  /// Half of the volume between the surface and the axis.
  static double half_volume(const Surface& surface, const Level& low, const Level& high) {
    if (surface.curve) return 0.5 * swept_volume(*surface.curve);
    return std::numbers::pi / 6.0 * (high.z - low.z) *
           (low.rho * low.rho + low.rho * high.rho + high.rho * high.rho);
  }

  const StepEntities& entities_;
  StepSolid solid_;
};

}  // namespace

Result<StepSolid> verify_step(std::string_view text, std::string_view name) {
  return parse_step(text, name).and_then([&](const StepEntities& entities) -> Result<StepSolid> {
    const auto wrong = [&](const std::string& what) {
      return failure(ErrorKind::unsound, std::string(name).append(": ").append(what));
    };
    try {
      return StepJudge(entities).run();
    } catch (const BadStep& problem) {
      return wrong(problem.what);
    } catch (const std::out_of_range&) {
      return wrong("expected more values in an entity");
    }
  });
}

}  // namespace clay::solid::inline formats
