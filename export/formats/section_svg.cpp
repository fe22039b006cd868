#include "claystack/export/formats.hpp"

#include "core/text.hpp"
#include "export/formats/svg_page.hpp"
#include "export/section/section_bodies.hpp"
#include "export/section/stack_section.hpp"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/vec2.hpp>
#include <limits>
#include <string>
#include <vector>

namespace clay::solid::inline formats {
namespace {

struct Extent {
  glm::dvec2 low{-1.0, 0.0};
  glm::dvec2 high{1.0, 1.0};
  [[nodiscard]] glm::dvec2 size() const { return high - low; }
  [[nodiscard]] Extent with(const std::vector<Outline>& outlines) const {
    Extent all = *this;
    for (const Outline& outline : outlines) {
      for (const glm::dvec2& p : outline) {
        all.low = glm::min(all.low, p);
        all.high = glm::max(all.high, p);
      }
    }
    return all;
  }
};

/// The wheel head (up = 0) is always included.
Extent extent_of(const std::vector<SectionBody>& bodies) {
  if (bodies.empty()) return {};
  constexpr double kFar = std::numeric_limits<double>::infinity();
  Extent extent{{kFar, 0.0}, {-kFar, 0.0}};
  for (const SectionBody& body : bodies) extent = extent.with(body.beyond);
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

  void ghosts(const std::vector<Outline>& all) {
    for (const Outline& ghost : all) page_.fill("ghost", on_page(std::vector<Outline>{ghost}));
  }

  /// The cut faces are drawn over everything beyond the cut, of any body.
  void bodies(const std::vector<SectionBody>& all) {
    for (const SectionBody& body : all) page_.fill("beyond", on_page(body.beyond));
    for (const SectionBody& body : all) page_.fill("cut", on_page(body.cut));
    for (const SectionBody& body : all) axis(body);
  }

  void axis(const SectionBody& body) {
    const glm::dvec2 from = on_page(body.axis[0]), to = on_page(body.axis[1]);
    const glm::dvec2 overhang = 22.0 * glm::normalize(to - from);
    page_.line("axis", from - overhang, to + overhang);
  }

  /// Dimension of the height of the point `top` above the wheel head.
  void height(glm::dvec2 top) {
    const double x = size_.x - kRight + 52.0;
    const glm::dvec2 from = on_page({top.x, 0.0}), to = on_page(top);
    page_.line("thin", {size_.x - kRight + 34.0, from.y}, {x + 6.0, from.y});
    page_.line("thin", {to.x + 5.0, to.y}, {x + 6.0, to.y});
    page_.dimension({x, from.y}, {x, to.y});
    page_.upright_text({x + 20.0, 0.5 * (from.y + to.y)}, millimetres(top.y));
  }

  /// Dimension of the width between two points, drawn above the pot.
  void width(glm::dvec2 left, glm::dvec2 right, const std::string& label) {
    const double y = kTop - 42.0;
    const glm::dvec2 from = on_page(left), to = on_page(right);
    page_.line("thin", {from.x, from.y - 5.0}, {from.x, y - 6.0});
    page_.line("thin", {to.x, to.y - 5.0}, {to.x, y - 6.0});
    page_.dimension({from.x, y}, {to.x, y});
    // Beside the axis, which runs through the middle.
    page_.text({0.5 * (from.x + to.x) + 8.0, y - 8.0}, label, SvgPage::Anchor::start);
  }

  void scale_bar() {
    const double mm = scale_bar_mm(extent_.size().x);
    const glm::dvec2 from{kLeft, size_.y - 30.0}, to{kLeft + mm * scale_, from.y};
    const glm::dvec2 tick{0.0, -6.0};
    page_.line("bold", from, to);
    page_.line("bold", from, from + tick);
    page_.line("bold", to, to + tick);
    page_.text(to + glm::dvec2{10.0, 2.0}, nine_digit_text(mm) + " mm", SvgPage::Anchor::start);
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

/// The lowest of the widest rings.
glm::dvec2 widest_point(const ClayStack& stack) {
  const auto rings = stack.rings();
  const auto widest = std::max_element(
      rings.begin(), rings.end(), [](const Ring& a, const Ring& b) { return a.outer2 < b.outer2; });
  const auto ring = static_cast<std::size_t>(widest - rings.begin());
  return {widest->outer_mm(), level_mm(stack, ring + 1)};
}

}  // namespace

std::string section_svg(const Pot& pot) {
  const std::vector<SectionBody> bodies = bodies_of(pot);
  const std::vector<Outline> ghosts = ghosts_of(pot);
  const Extent extent = extent_of(bodies);
  Drawing drawing(extent.with(ghosts));
  drawing.wheel_head();
  drawing.ghosts(ghosts);
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

}  // namespace clay::solid::inline formats
