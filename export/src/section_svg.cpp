#include "claystack/export/section_svg.hpp"

#include "describe.hpp"
#include "stack_section.hpp"
#include "svg_page.hpp"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/vec2.hpp>
#include <limits>
#include <string>
#include <vector>

namespace clay::solid {
namespace {

using Outline = std::vector<glm::dvec2>;  // (right, up) in mm, seen along the cut

/// One rigid body as the knife leaves it.
struct Body {
  std::vector<Outline> cut;     ///< the clay that the knife met: fill by the even-odd rule
  std::vector<Outline> beyond;  ///< the half behind, whose bore shows
  Outline axis;
};

/// A line right of the axis and its mirror image, joined into one outline.
Outline mirrored(const Polygon& line) {
  Outline outline;
  for (const ProfilePoint& p : line) outline.emplace_back(p.rho, p.y);
  for (auto p = line.rbegin(); p != line.rend(); ++p) outline.emplace_back(-p->rho, p->y);
  return outline;
}

/// Chains that end on the axis close with their mirror images, so that no seam shows there.
void add_cut(Body& body, const Polygon& section) {
  for (const Chain& chain : chains_of(section)) {
    Polygon line;
    for (std::size_t i = 0; i <= chain.edges; ++i)
      line.push_back(section[(chain.first + i) % section.size()]);
    if (!chain.round) {
      body.cut.push_back(mirrored(line));
      continue;
    }
    for (const double side : {1.0, -1.0}) {
      Outline& outline = body.cut.emplace_back();
      for (const ProfilePoint& p : line) outline.emplace_back(side * p.rho, p.y);
    }
  }
}

Body body_of(const ClayStack& stack, RingRange rings) {
  Body body;
  for (const RingRange piece : pieces_of(stack, rings)) {
    add_cut(body, section_of(stack, piece));
    body.beyond.push_back(mirrored(outer_wall_of(stack, piece)));
  }
  body.axis = {{0.0, level_mm(stack, rings.first)}, {0.0, level_mm(stack, rings.last + 1)}};
  return body;
}

/// Turns a body about the pivot, in the plane through the pot's axis across the turning axis.
void turn(Body& body, const Collapse& collapse) {
  const glm::dvec2 pivot{
      collapse.pivot_mm.x * collapse.axis.z - collapse.pivot_mm.z * collapse.axis.x,
      collapse.pivot_mm.y};
  const double c = std::cos(collapse.angle_rad), s = std::sin(collapse.angle_rad);
  const auto turn_outline = [&](Outline& outline) {
    for (glm::dvec2& p : outline) {
      const glm::dvec2 arm = p - pivot;
      p = pivot + glm::dvec2{c * arm.x - s * arm.y, s * arm.x + c * arm.y};
    }
  };
  std::for_each(body.cut.begin(), body.cut.end(), turn_outline);
  std::for_each(body.beyond.begin(), body.beyond.end(), turn_outline);
  turn_outline(body.axis);
}

std::vector<Body> bodies_of(const Pot& pot) {
  const std::size_t rings = pot.stack.size();
  if (rings == 0) return {};
  if (!pot.collapse) return {body_of(pot.stack, {0, rings - 1})};
  const std::size_t failed = std::min(pot.collapse->failed_ring, rings - 1);
  std::vector<Body> bodies{body_of(pot.stack, {0, failed})};
  if (failed + 1 < rings) {
    bodies.push_back(body_of(pot.stack, {failed + 1, rings - 1}));
    turn(bodies.back(), *pot.collapse);
  }
  return bodies;
}

struct Extent {
  glm::dvec2 low{-1.0, 0.0};
  glm::dvec2 high{1.0, 1.0};
  [[nodiscard]] glm::dvec2 size() const { return high - low; }
};

/// The wheel head (up = 0) is always in the picture.
Extent extent_of(const std::vector<Body>& bodies) {
  if (bodies.empty()) return {};
  constexpr double kFar = std::numeric_limits<double>::infinity();
  Extent extent{{kFar, 0.0}, {-kFar, 0.0}};
  for (const Body& body : bodies) {
    for (const Outline& outline : body.beyond) {
      for (const glm::dvec2& p : outline) {
        extent.low = glm::min(extent.low, p);
        extent.high = glm::max(extent.high, p);
      }
    }
  }
  return extent;
}

std::string millimetres(double mm) { return fixed(mm, 1) + " mm"; }

/// The longest of 1, 2, 5, 10, ... mm within two fifths of the width.
double scale_bar_mm(double width_mm) {
  const double longest = 0.4 * width_mm;
  const double decade = std::pow(10.0, std::floor(std::log10(longest)));
  for (const double step : {5.0, 2.0})
    if (step * decade <= longest) return step * decade;
  return decade;
}

constexpr double kLargest = 460.0;  // of the clay, in px
constexpr double kLeft = 70.0, kRight = 110.0, kTop = 88.0, kBottom = 92.0;

class Drawing {
 public:
  explicit Drawing(const Extent& extent)
      : extent_(extent),
        scale_(kLargest / std::max(extent.size().x, extent.size().y)),
        size_(extent.size() * scale_ + glm::dvec2{kLeft + kRight, kTop + kBottom}),
        page_(size_, "Section of a pot") {}

  void wheel_head() {
    const glm::dvec2 left{kLeft - 30.0, on_page({0.0, 0.0}).y};
    const glm::dvec2 right{size_.x - kRight + 30.0, left.y};
    page_.rectangle("ground", left, {right.x - left.x, 9.0});
    page_.line("bold", left, right);
  }

  /// What is cut stands before all that lies beyond, of whichever body.
  void bodies(const std::vector<Body>& all) {
    for (const Body& body : all) page_.fill("beyond", on_page(body.beyond));
    for (const Body& body : all) page_.fill("cut", on_page(body.cut));
    for (const Body& body : all) axis(body);
  }

  void axis(const Body& body) {
    const glm::dvec2 from = on_page(body.axis[0]), to = on_page(body.axis[1]);
    const glm::dvec2 overhang = 22.0 * glm::normalize(to - from);
    page_.line("axis", from - overhang, to + overhang);
  }

  /// Of the point `top`, from the wheel head.
  void height(glm::dvec2 top) {
    const double x = size_.x - kRight + 52.0;
    const glm::dvec2 from = on_page({top.x, 0.0}), to = on_page(top);
    page_.line("thin", {size_.x - kRight + 34.0, from.y}, {x + 6.0, from.y});
    page_.line("thin", {to.x + 5.0, to.y}, {x + 6.0, to.y});
    page_.dimension({x, from.y}, {x, to.y});
    page_.upright_text({x + 20.0, 0.5 * (from.y + to.y)}, millimetres(top.y));
  }

  /// Between two points, measured above the pot.
  void width(glm::dvec2 left, glm::dvec2 right, const std::string& label) {
    const double y = kTop - 42.0;
    const glm::dvec2 from = on_page(left), to = on_page(right);
    page_.line("thin", {from.x, from.y - 5.0}, {from.x, y - 6.0});
    page_.line("thin", {to.x, to.y - 5.0}, {to.x, y - 6.0});
    page_.dimension({from.x, y}, {to.x, y});
    // Beside the axis, which rises through the middle.
    page_.text({0.5 * (from.x + to.x) + 8.0, y - 8.0}, label, SvgPage::Anchor::start);
  }

  void scale_bar() {
    const double mm = scale_bar_mm(extent_.size().x);
    const glm::dvec2 from{kLeft, size_.y - 30.0}, to{kLeft + mm * scale_, from.y};
    const glm::dvec2 tick{0.0, -6.0};
    page_.line("bold", from, to);
    page_.line("bold", from, from + tick);
    page_.line("bold", to, to + tick);
    page_.text(to + glm::dvec2{10.0, 2.0}, in_mm(mm) + " mm", SvgPage::Anchor::start);
  }

  void caption(const std::string& label) {
    page_.text({size_.x - 36.0, size_.y - 28.0}, label, SvgPage::Anchor::end);
  }

  std::string finish() { return page_.finish(); }

 private:
  [[nodiscard]] glm::dvec2 on_page(glm::dvec2 mm) const {
    return {kLeft + (mm.x - extent_.low.x) * scale_, kTop + (extent_.high.y - mm.y) * scale_};
  }
  [[nodiscard]] std::vector<Outline> on_page(std::vector<Outline> outlines) const {
    for (Outline& outline : outlines)
      for (glm::dvec2& p : outline) p = on_page(p);
    return outlines;
  }

  Extent extent_;
  double scale_;     ///< px per mm
  glm::dvec2 size_;  ///< px
  SvgPage page_;
};

/// Where the pot is widest: the lowest such ring.
glm::dvec2 widest_point(const ClayStack& stack) {
  const auto rings = stack.rings();
  const auto widest = std::max_element(
      rings.begin(), rings.end(), [](const Ring& a, const Ring& b) { return a.outer2 < b.outer2; });
  const auto ring = static_cast<std::size_t>(widest - rings.begin());
  return {widest->outer_mm(), level_mm(stack, ring + 1)};
}

}  // namespace

std::string section_svg(const Pot& pot) {
  const std::vector<Body> bodies = bodies_of(pot);
  const Extent extent = extent_of(bodies);
  Drawing drawing(extent);
  drawing.wheel_head();
  drawing.bodies(bodies);
  if (pot.collapse) {
    drawing.height(extent.high);
    drawing.width({extent.low.x, extent.high.y}, extent.high, millimetres(extent.size().x));
  } else if (!bodies.empty()) {
    const glm::dvec2 widest = widest_point(pot.stack);
    drawing.height({pot.stack.rings().back().outer_mm(), extent.high.y});
    drawing.width({-widest.x, widest.y}, widest, "\u2300 " + millimetres(2.0 * widest.x));
  }
  drawing.scale_bar();
  drawing.caption(fixed(pot.stack.volume_mm3() / 1000.0, 1) + " cm\u00b3");
  return drawing.finish();
}

}  // namespace clay::solid
