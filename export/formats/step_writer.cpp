#include "export/formats/step.hpp"

#include "claystack/version.hpp"
#include "core/svg_writer.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <numbers>
#include <unordered_set>
#include <utility>
#include <vector>

namespace clay::solid::inline formats {
namespace {

/// A REAL of at most `digits` decimals: "0.", "12.5".
std::string real(double number, int digits = 9) {
  constexpr double kWhole = 1e15;  // whole numbers below it are the same text, much faster
  if (std::abs(number) < kWhole && number == std::trunc(number))
    return std::to_string(static_cast<long long>(number)) + ".";
  std::string text = fixed(number + 0.0, digits);
  while (text.back() == '0') text.pop_back();
  return text == "-0." ? "0." : text;
}

/// A STRING: quotes are doubled, everything but printable ASCII becomes a question mark.
std::string step_string(std::string_view words) {
  std::string text = "'";
  for (const char c : words) {
    text += c >= ' ' && c <= '~' ? c : '?';
    if (c == '\'' || c == '\\') text += c;
  }
  return text + "'";
}

/// A reference to an entity, "#12".
using Ref = std::string;

std::string listed(const std::vector<Ref>& refs) {
  std::string text = "(";
  for (const Ref& ref : refs) text.append(text.size() > 1 ? "," : "").append(ref);
  return text + ")";
}

/// The DATA section. Equal entities are written once.
class StepData {
 public:
  StepData() = default;
  StepData(const StepData&) = delete;  // `known_` points into it
  StepData& operator=(const StepData&) = delete;

  template <class... Parts>
  Ref add(const Parts&... parts) {
    Ref ref("#");  // in two steps: GCC 12 gives a false warning for a sum of both
    ref.append(std::to_string(known_.size() + 1));
    const std::size_t line = text_.size();
    text_.append(ref).append("=");
    const std::size_t begin = text_.size();
    (text_.append(parts), ...);
    const auto [same, is_new] = known_.insert({line, begin, text_.size() - begin});
    if (is_new) {
      text_.append(";\n");
      return ref;
    }
    text_.resize(line);
    return text_.substr(same->line, same->begin - 1 - same->line);
  }
  Ref point(double x, double y, double z) {
    return add("CARTESIAN_POINT('',(", real(x), ",", real(y), ",", real(z), "))");
  }
  Ref direction(double x, double y, double z) {
    return add("DIRECTION('',(", real(x, 16), ",", real(y, 16), ",", real(z, 16), "))");
  }
  /// A frame on the axis at this height; its own axis points up or down.
  Ref frame(double height, double up = 1.0) {
    // One after the other: compilers differ in the order of arguments, and it numbers the entities.
    const Ref across = direction(1.0, 0.0, 0.0), along = direction(0.0, 0.0, up);
    return add("AXIS2_PLACEMENT_3D('',", point(0.0, 0.0, height), ",", along, ",", across, ")");
  }
  [[nodiscard]] const std::string& text() const noexcept { return text_; }

 private:
  /// "#12=ENTITY(...)": where the line and the entity begin in `text_`.
  struct Entity {
    std::size_t line = 0, begin = 0, size = 0;
  };
  struct SameText {
    const std::string* text;
    [[nodiscard]] std::string_view of(const Entity& entity) const {
      return std::string_view(*text).substr(entity.begin, entity.size);
    }
    std::size_t operator()(const Entity& entity) const {
      return std::hash<std::string_view>()(of(entity));
    }
    bool operator()(const Entity& a, const Entity& b) const { return of(a) == of(b); }
  };

  std::string text_;
  std::unordered_set<Entity, SameText, SameText> known_{0, SameText{&text_}, SameText{&text_}};
};

/// Both halves of something: from azimuth 0 to a half turn, and back.
using Halves = std::array<Ref, 2>;

class ShellWriter {
 public:
  ShellWriter(StepData& data, const BrepShell& shell) : data_(data) {
    std::vector<Ref> faces;
    const bool round = shell.front().from == shell.back().to;
    const Circle first = circle(shell.front().from);
    Circle below = first;
    for (const BrepWall& wall : shell) {
      const bool last = &wall == &shell.back();
      const Circle above = last && round ? first : circle(wall.to);
      if (wall.flat())
        faces.push_back(flat_face(wall, below, above));
      else
        add_halves(wall, below, above, faces);
      below = above;
    }
    closed_shell_ = data_.add("CLOSED_SHELL('',", listed(faces), ")");
  }

  [[nodiscard]] const Ref& ref() const noexcept { return closed_shell_; }

 private:
  /// A circle around the axis, cut at azimuths 0 and 180; none at a pole.
  struct Circle {
    Halves vertices, arcs;
  };

  static double side(std::size_t half) { return half == 0 ? 1.0 : -1.0; }

  Circle circle(const ProfilePoint& p) {
    Circle made;
    if (p.rho == 0.0) return made;
    for (std::size_t half = 0; half < 2; ++half)
      made.vertices[half] =
          data_.add("VERTEX_POINT('',", data_.point(side(half) * p.rho, 0.0, p.y), ")");
    const Ref curve = data_.add("CIRCLE('',", data_.frame(p.y), ",", real(p.rho), ")");
    for (std::size_t half = 0; half < 2; ++half)
      made.arcs[half] = data_.add("EDGE_CURVE('',", made.vertices[half], ",",
                                  made.vertices[1 - half], ",", curve, ",.T.)");
    return made;
  }

  Ref use(const Ref& edge, bool forward) {
    return data_.add("ORIENTED_EDGE('',*,*,", edge, forward ? ",.T.)" : ",.F.)");
  }
  Ref loop(const std::vector<Ref>& edges) { return data_.add("EDGE_LOOP('',", listed(edges), ")"); }
  Ref face(const std::vector<Ref>& bounds, const Ref& surface, bool same_sense) {
    return data_.add("ADVANCED_FACE('',", listed(bounds), ",", surface,
                     same_sense ? ",.T.)" : ",.F.)");
  }

  /// A disc or an annulus; its plane's normal points out of the clay.
  Ref flat_face(const BrepWall& wall, const Circle& from, const Circle& to) {
    const bool outward = wall.to.rho > wall.from.rho;
    std::vector<Ref> bounds;
    const auto bound = [&](const Circle& circle, bool forward, bool outer) {
      if (circle.arcs[0].empty()) return;
      const std::size_t first = forward ? 0 : 1;
      bounds.push_back(data_.add(
          outer ? "FACE_OUTER_BOUND(''," : "FACE_BOUND('',",
          loop({use(circle.arcs[first], forward), use(circle.arcs[1 - first], forward)}), ",.T.)"));
    };
    if (outward) {
      bound(to, false, true);
      bound(from, true, false);
    } else {
      bound(from, true, true);
      bound(to, false, false);
    }
    const Ref plane = data_.add("PLANE('',", data_.frame(wall.from.y, outward ? -1.0 : 1.0), ")");
    return face(bounds, plane, true);
  }

  void add_halves(const BrepWall& wall, const Circle& from, const Circle& to,
                  std::vector<Ref>& faces) {
    Halves meridians;
    for (std::size_t half = 0; half < 2; ++half)
      meridians[half] =
          data_.add("EDGE_CURVE('',", from.vertices[half], ",", to.vertices[half], ",",
                    wall.curve ? spline(*wall.curve, half) : line(wall, half), ",.T.)");
    const Ref straight = wall.curve ? Ref() : straight_surface(wall);
    for (std::size_t half = 0; half < 2; ++half) {
      const Ref edges = loop({use(from.arcs[half], true), use(meridians[1 - half], true),
                              use(to.arcs[half], false), use(meridians[half], false)});
      const Ref bound = data_.add("FACE_OUTER_BOUND('',", edges, ",.T.)");
      // The normal of a cylinder or cone points away from the axis.
      faces.push_back(wall.curve ? face({bound}, spline_surface(*wall.curve, half), true)
                                 : face({bound}, straight, wall.to.y > wall.from.y));
    }
  }

  Ref line(const BrepWall& wall, std::size_t half) {
    const double rho = wall.to.rho - wall.from.rho, y = wall.to.y - wall.from.y;
    const double length = std::hypot(rho, y);
    const Ref vector = data_.add(
        "VECTOR('',", data_.direction(side(half) * rho / length, 0.0, y / length), ",1.)");
    return data_.add("LINE('',", data_.point(side(half) * wall.from.rho, 0.0, wall.from.y), ",",
                     vector, ")");
  }

  /// A cone opens in the direction of its own axis.
  Ref straight_surface(const BrepWall& wall) {
    const double rho = wall.to.rho - wall.from.rho, y = wall.to.y - wall.from.y;
    if (rho == 0.0)
      return data_.add("CYLINDRICAL_SURFACE('',", data_.frame(wall.from.y), ",",
                       real(wall.from.rho), ")");
    const ProfilePoint& narrow = rho > 0.0 ? wall.from : wall.to;
    return data_.add("CONICAL_SURFACE('',", data_.frame(narrow.y, rho * y > 0.0 ? 1.0 : -1.0), ",",
                     real(narrow.rho), ",", real(std::atan2(std::abs(rho), std::abs(y)), 16), ")");
  }

  static std::string multiplicities(const WallCurve& curve) {
    std::string text = "(4";
    for (std::size_t i = 1; i + 1 < curve.knots.size(); ++i) text += ",1";
    return text + ",4)";
  }
  /// Dyadic knots become the shortest whole numbers.
  static std::string knots(const WallCurve& curve) {
    const auto whole = [&](double scale) {
      return std::ranges::all_of(curve.knots,
                                 [&](double k) { return k * scale == std::floor(k * scale); });
    };
    double scale = 1.0;
    while (!whole(scale)) scale *= 2.0;
    std::string text = "(";
    for (const double knot : curve.knots)
      text.append(text.size() > 1 ? "," : "").append(real(knot * scale, 1));
    return text + ")";
  }

  Ref spline(const WallCurve& curve, std::size_t half) {
    std::vector<Ref> points;
    for (const ProfilePoint& p : curve.control)
      points.push_back(data_.point(side(half) * p.rho, 0.0, p.y));
    return data_.add("B_SPLINE_CURVE_WITH_KNOTS('',3,", listed(points), ",.UNSPECIFIED.,.F.,.F.,",
                     multiplicities(curve), ",", knots(curve), ",.UNSPECIFIED.)");
  }

  /// Half a circle is one rational cubic: the points (1, 0), (1, 2), (-1, 2), (-1, 0) with the
  /// weights 3, 1, 1, 3. The curve is the first parameter: Open CASCADE integrates a face along the
  /// second one without regard to knots. The circle runs backwards, so that the normal points out.
  Ref spline_surface(const WallCurve& curve, std::size_t half) {
    constexpr std::array<std::array<double, 2>, 4> kHalfCircle{{{-1, 0}, {-1, 2}, {1, 2}, {1, 0}}};
    std::vector<Ref> rows;
    for (const ProfilePoint& p : curve.control) {
      std::vector<Ref> points;
      for (const auto& [across, aside] : kHalfCircle)
        points.push_back(data_.point(side(half) * across * p.rho, side(half) * aside * p.rho, p.y));
      rows.push_back(listed(points));
    }
    const std::vector<Ref> weights(rows.size(), "(3.,1.,1.,3.)");
    return data_.add(
        "(BOUNDED_SURFACE()B_SPLINE_SURFACE(3,3,", listed(rows),
        ",.UNSPECIFIED.,.F.,.F.,.F.)B_SPLINE_SURFACE_WITH_KNOTS(", multiplicities(curve), ",(4,4),",
        knots(curve),
        ",(0.,1.),.UNSPECIFIED.)GEOMETRIC_REPRESENTATION_ITEM()RATIONAL_B_SPLINE_SURFACE(",
        listed(weights), ")REPRESENTATION_ITEM('')SURFACE())");
  }

  StepData& data_;
  Ref closed_shell_;
};

Ref solid_of(StepData& data, const BrepBody& body, const std::string& name) {
  std::vector<Ref> shells;
  for (const BrepShell& shell : body) shells.push_back(ShellWriter(data, shell).ref());
  if (shells.size() == 1) return data.add("MANIFOLD_SOLID_BREP(", name, ",", shells[0], ")");
  std::vector<Ref> voids;
  for (std::size_t i = 1; i < shells.size(); ++i)
    voids.push_back(data.add("ORIENTED_CLOSED_SHELL('',*,", shells[i], ",.T.)"));
  return data.add("BREP_WITH_VOIDS(", name, ",", shells[0], ",", listed(voids), ")");
}

/// Millimetres, radians, and the accuracy of the coordinates.
Ref units(StepData& data) {
  const Ref mm = data.add("(LENGTH_UNIT()NAMED_UNIT(*)SI_UNIT(.MILLI.,.METRE.))");
  const Ref angle = data.add("(NAMED_UNIT(*)PLANE_ANGLE_UNIT()SI_UNIT($,.RADIAN.))");
  const Ref solid_angle = data.add("(NAMED_UNIT(*)SI_UNIT($,.STERADIAN.)SOLID_ANGLE_UNIT())");
  const Ref accuracy = data.add("UNCERTAINTY_MEASURE_WITH_UNIT(LENGTH_MEASURE(1.E-6),", mm,
                                ",'distance_accuracy_value','')");
  return data.add("(GEOMETRIC_REPRESENTATION_CONTEXT(3)GLOBAL_UNCERTAINTY_ASSIGNED_CONTEXT((",
                  accuracy, "))GLOBAL_UNIT_ASSIGNED_CONTEXT(", listed({mm, angle, solid_angle}),
                  ")REPRESENTATION_CONTEXT('',''))");
}

/// The product to which the shape belongs.
void add_product(StepData& data, const Ref& shape, const std::string& name) {
  const Ref context = data.add("APPLICATION_CONTEXT('automotive design')");
  data.add("APPLICATION_PROTOCOL_DEFINITION('international standard','automotive_design',2000,",
           context, ")");
  const Ref product = data.add("PRODUCT(", name, ",", name, ",'',(",
                               data.add("PRODUCT_CONTEXT('',", context, ",'mechanical')"), "))");
  data.add("PRODUCT_RELATED_PRODUCT_CATEGORY('part',$,(", product, "))");
  const Ref part = data.add("PRODUCT_DEFINITION_CONTEXT('part definition',", context, ",'design')");
  const Ref formation = data.add("PRODUCT_DEFINITION_FORMATION('','',", product, ")");
  const Ref definition = data.add("PRODUCT_DEFINITION('design','',", formation, ",", part, ")");
  data.add("SHAPE_DEFINITION_REPRESENTATION(",
           data.add("PRODUCT_DEFINITION_SHAPE('','',", definition, ")"), ",", shape, ")");
}

}  // namespace

std::string encode_step(const RevolvedBrep& brep, std::string_view name) {
  StepData data;
  const std::string title = step_string(name);
  std::vector<Ref> items{data.frame(0.0)};
  for (const BrepBody& body : brep.bodies) items.push_back(solid_of(data, body, title));
  const Ref shape = data.add("ADVANCED_BREP_SHAPE_REPRESENTATION(", title, ",", listed(items), ",",
                             units(data), ")");
  add_product(data, shape, title);
  const std::string program = step_string("claystack " CLAYSTACK_VERSION);
  return "ISO-10303-21;\nHEADER;\nFILE_DESCRIPTION((''),'2;1');\nFILE_NAME(" + title +
         ",'1980-01-01T00:00:00',(''),('')," + program + "," + program +
         ",'');\nFILE_SCHEMA(('AUTOMOTIVE_DESIGN { 1 0 10303 214 1 1 1 1 }'));\nENDSEC;\nDATA;\n" +
         data.text() + "ENDSEC;\nEND-ISO-10303-21;\n";
}

}  // namespace clay::solid::inline formats
