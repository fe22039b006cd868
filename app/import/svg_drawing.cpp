#include "app/import/curves.hpp"
#include "app/import/readers.hpp"
#include "app/import/svg_shapes.hpp"
#include "core/text.hpp"
#include "core/xml_attributes.hpp"

#include <fmt/format.h>
#include <libxml/SAX2.h>
#include <libxml/parser.h>
#include <libxml/tree.h>

#include <boost/exception/all.hpp>
#include <boost/mpl/insert.hpp>
#include <boost/mpl/set.hpp>
#include <svgpp/policy/xml/libxml2.hpp>
#include <svgpp/svgpp.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <exception>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/mat3x3.hpp>
#include <limits>
#include <memory>
#include <numbers>
#include <span>
#include <stdexcept>

namespace clay::importing {
namespace {

constexpr double kMmPerPx = 25.4 / 96.0;
/// Of a page that states no size: lengths that refer to it are not numbers.
constexpr double kNoSize = std::numeric_limits<double>::quiet_NaN();
constexpr std::ptrdiff_t kMostNodes = 1'000'000;  // the tree of each takes some 200 bytes

/// Derives from the library's exception class, so that the library adds the element.
struct Refusal : boost::exception, std::runtime_error {
  using std::runtime_error::runtime_error;
};

struct Minimal : svgpp::policy::path::minimal {
  static const bool arc_as_cubic_bezier = false;  // a cubic would deviate by 3e-4 of the radius
};

/// An SVG arc, given by its ends, as centre + cos(t) u + sin(t) v (SVG 2, appendix B.2.4).
struct Arc {
  glm::dvec2 centre{0.0}, u{0.0}, v{0.0};
  double from = 0.0, to = 0.0;
};

double cross(glm::dvec2 a, glm::dvec2 b) { return a.x * b.y - a.y * b.x; }

Arc arc_between(glm::dvec2 first, glm::dvec2 last, glm::dvec2 radii, double turned_rad, bool large,
                bool sweep) {
  const glm::dvec2 x{std::cos(turned_rad), std::sin(turned_rad)}, y{-x.y, x.x};
  const glm::dvec2 half = 0.5 * (first - last);
  // In the ellipse's axes and scaled by its radii it is a unit circle.
  glm::dvec2 start = glm::dvec2{glm::dot(x, half), glm::dot(y, half)} / radii;
  const double grown = std::max(1.0, glm::length(start));  // radii too short for the ends
  radii *= grown;
  start /= grown;
  const double square = glm::dot(start, start);
  const double away = square > 0.0 ? std::sqrt(std::max(0.0, 1.0 / square - 1.0)) : 0.0;
  const glm::dvec2 middle = (large == sweep ? -away : away) * glm::dvec2{start.y, -start.x};
  const glm::dvec2 a = start - middle, b = -start - middle;
  Arc arc{0.5 * (first + last) + x * (radii.x * middle.x) + y * (radii.y * middle.y), radii.x * x,
          radii.y * y, std::atan2(a.y, a.x), 0.0};
  double turn = std::atan2(cross(a, b), glm::dot(a, b));
  if (sweep && turn < 0.0) turn += 2.0 * std::numbers::pi;
  if (!sweep && turn > 0.0) turn -= 2.0 * std::numbers::pi;
  arc.to = arc.from + turn;
  return arc;
}

/// Receives shapes from the library as moves, lines, cubics and arcs; stores them in mm.
class Collector {
 public:
  explicit Collector(double scale) : mm_per_px_(scale * kMmPerPx) {}

  std::vector<Line> lines;

  /// Lengths in the user's units: percentages are of the viewport around the element.
  using Lengths = svgpp::factory::length::unitless<>;
  [[nodiscard]] const Lengths& length_factory() const { return states_.back().lengths; }

  void on_enter_element(svgpp::tag::element::any) { states_.push_back(states_.back()); }
  void on_exit_element() { states_.pop_back(); }

  void transform_matrix(const boost::array<double, 6>& m) {
    states_.back().to_page =
        states_.back().to_page * glm::dmat3{m[0], m[1], 0.0, m[2], m[3], 0.0, m[4], m[5], 1.0};
  }
  void set_viewport(double, double, double width, double height) { set_size(width, height); }
  void set_viewbox_size(double width, double height) { set_size(width, height); }
  void disable_rendering() { states_.back().shown = false; }

  void path_move_to(double x, double y, svgpp::tag::coordinate::absolute) {
    end_line();
    line_.points_mm.push_back(at(x, y));
    check(1);
    pen_ = restart_ = {x, y};
  }
  void path_line_to(double x, double y, svgpp::tag::coordinate::absolute) {
    begin_again();
    line_.points_mm.push_back(at(x, y));
    check(1);
    pen_ = {x, y};
  }
  void path_cubic_bezier_to(double x1, double y1, double x2, double y2, double x, double y,
                            svgpp::tag::coordinate::absolute) {
    begin_again();
    const std::size_t before = line_.points_mm.size();
    const std::array steering{at(x1, y1), at(x2, y2)};
    refuse(PointLimits::out_of_bounds(steering));
    append_cubic(line_.points_mm, line_.points_mm.back(), steering[0], steering[1], at(x, y));
    check(line_.points_mm.size() - before);
    pen_ = {x, y};
  }
  void path_elliptical_arc_to(double rx, double ry, double turned_degrees, bool large, bool sweep,
                              double x, double y, svgpp::tag::coordinate::absolute) {
    const glm::dvec2 end{x, y};
    if (end == pen_) return;  // SVG draws nothing here
    if (rx == 0.0 || ry == 0.0) return path_line_to(x, y, {});
    begin_again();
    const Arc arc = arc_between(pen_, end, glm::abs(glm::dvec2{rx, ry}),
                                turned_degrees * std::numbers::pi / 180.0, large, sweep);
    const glm::dvec2 origin = at(0.0, 0.0);
    const std::size_t before = line_.points_mm.size();
    append_arc(line_.points_mm, at(arc.centre.x, arc.centre.y), at(arc.u.x, arc.u.y) - origin,
               at(arc.v.x, arc.v.y) - origin, arc.from, arc.to);
    line_.points_mm.back() = at(x, y);
    check(line_.points_mm.size() - before);
    pen_ = end;
  }
  void path_close_subpath() {
    if (line_.points_mm.empty()) return;
    pen_ = restart_;
    if (line_.points_mm.size() > 2 && line_.points_mm.back() == line_.points_mm.front())
      line_.points_mm.pop_back();
    line_.closed = true;
    end_line();
  }
  void path_exit() {
    end_line();
    line_ = {};
  }

 private:
  struct State {
    glm::dmat3 to_page{1.0};
    bool shown = true;
    bool sized = false;  ///< the viewport has a width and a height
    Lengths lengths{of_size(kNoSize, kNoSize)};
  };

  static Lengths of_size(double width, double height) {
    Lengths lengths;
    lengths.set_viewport_size(width, height);
    return lengths;
  }
  void set_size(double width, double height) {
    states_.back().lengths = of_size(width, height);
    states_.back().sized = std::isfinite(width) && std::isfinite(height);
  }

  /// y points down on a page.
  [[nodiscard]] glm::dvec2 at(double x, double y) const {
    const glm::dvec3 p = states_.back().to_page * glm::dvec3{x, y, 1.0};
    if (!states_.back().sized && (std::isnan(p.x) || std::isnan(p.y)))
      throw Refusal(
          "expected a viewBox, or a width and a height of the drawing, because a length refers to "
          "its size; found none");
    return mm_per_px_ * glm::dvec2{p.x, -p.y};
  }

  /// After a closed subpath the next one may begin without a move, at the same start.
  void begin_again() {
    if (!line_.points_mm.empty()) return;
    line_.points_mm.push_back(at(pen_.x, pen_.y));
    check(1);
  }

  /// Checks the most recent points.
  void check(std::size_t count) {
    refuse(limits_.problem_with(std::span(line_.points_mm).last(count)));
  }
  static void refuse(const std::string& problem) {
    if (!problem.empty()) throw Refusal(problem);
  }

  void end_line() {
    if (line_.points_mm.size() > 1 && states_.back().shown) lines.push_back(std::move(line_));
    line_ = {};
  }

  double mm_per_px_;
  std::vector<State> states_{State{}};
  Line line_;
  PointLimits limits_;
  glm::dvec2 pen_{0.0}, restart_{0.0};  // in the shape's coordinates
};

using Elements = boost::mpl::fold<svgpp::traits::shape_elements,
                                  boost::mpl::set<svgpp::tag::element::svg, svgpp::tag::element::g>,
                                  boost::mpl::insert<boost::mpl::_1, boost::mpl::_2>>::type;

using Attributes =
    boost::mpl::fold<boost::mpl::joint_view<svgpp::traits::shapes_attributes_by_element,
                                            svgpp::traits::viewport_attributes>,
                     boost::mpl::set<svgpp::tag::attribute::transform>,
                     boost::mpl::insert<boost::mpl::_1, boost::mpl::_2>>::type;

using Traversal = svgpp::document_traversal<
    svgpp::processed_elements<Elements>, svgpp::processed_attributes<Attributes>,
    svgpp::viewport_policy<svgpp::policy::viewport::as_transform>, svgpp::path_policy<Minimal>,
    svgpp::length_policy<
        svgpp::policy::length::forward_to_method<Collector, const Collector::Lengths>>>;

/// Shortens the library's messages, which quote whole attributes, to one line.
std::string shortened(std::string_view text) { return shown(text, 160); }

std::string libxml_problem(const std::string& name) {
  const auto* error = xmlGetLastError();
  if (error == nullptr) return name + ": expected an SVG drawing";
  std::string message = error->message == nullptr ? "no XML" : error->message;
  while (!message.empty() && message.back() == '\n') message.pop_back();
  return fmt::format("{}:{}: expected an SVG drawing, found: {}", name, error->line,
                     shortened(message));
}

/// ":LINE" of the element of an error, if the library knows it.
std::string line_of(const boost::exception& error) {
  using Element = boost::error_info<svgpp::tag::error_info::xml_element, xmlNode*>;
  xmlNode* const* element = boost::get_error_info<Element>(error);
  return element == nullptr ? "" : fmt::format(":{}", svg_line(*element));
}

void start_element(void* parser, const xmlChar* name, const xmlChar* prefix, const xmlChar* space,
                   int spaces, const xmlChar** all_spaces, int attributes, int defaulted,
                   const xmlChar** all_attributes) {
  xmlSAX2StartElementNs(parser, name, prefix, space, spaces, all_spaces, attributes, defaulted,
                        all_attributes);
  const auto* context = static_cast<xmlParserCtxt*>(parser);
  if (context->node != nullptr) note_svg_line(*context->node, context->input->line);
}

/// Null if the bytes are not XML. Fetches nothing and expands no entities: only the file itself is
/// read.
XmlDocument parsed(std::string_view bytes, int options) {
  const std::unique_ptr<xmlParserCtxt, decltype(&xmlFreeParserCtxt)> parser(xmlNewParserCtxt(),
                                                                            &xmlFreeParserCtxt);
  if (!parser) throw std::bad_alloc();
  parser->sax->startElementNs = start_element;
  xmlDoc* document = xmlCtxtReadMemory(
      parser.get(), bytes.data(), static_cast<int>(bytes.size()), nullptr, nullptr,
      XML_PARSE_NONET | XML_PARSE_NOERROR | XML_PARSE_NOWARNING | options);
  return {document, &xmlFreeDoc};
}

}  // namespace

Result<Drawing> read_svg(std::string_view bytes, const std::string& name, const std::string& layer,
                         double scale) {
  const auto nodes =
      std::count_if(bytes.begin(), bytes.end(), [](char c) { return c == '<' || c == '='; });
  if (nodes > kMostNodes)
    return failure(ErrorKind::bad_input,
                   fmt::format("{}: expected at most {} tags and attributes, found {}", name,
                               kMostNodes, nodes));
  XmlAttributeLimit limit;
  if (const auto fault = limit.take(bytes))
    return failure(ErrorKind::bad_input, fmt::format("{}:{}: {}", name, fault->line, fault->what));
  // Long attributes are allowed where there are no entities, because the option also lifts the
  // limit of their growth.
  const bool entities = limit.wide() || bytes.find("<!ENTITY") != std::string_view::npos;
  const XmlDocument document = parsed(bytes, entities ? 0 : XML_PARSE_HUGE);
  if (!document || xmlDocGetRootElement(document.get()) == nullptr)
    return failure(ErrorKind::bad_input, libxml_problem(name));
  auto shapes = svg_shapes(*document, layer, name);
  if (!shapes) return tl::make_unexpected(shapes.error());
  xmlNode* root = xmlDocGetRootElement(shapes->document.get());
  Collector collector(scale);
  try {
    Traversal::load_document(root, collector);
  } catch (const Refusal& refusal) {
    return failure(ErrorKind::bad_input,
                   fmt::format("{}{}: {}", name, line_of(refusal), refusal.what()));
  } catch (const svgpp::exception_base& error) {
    return failure(ErrorKind::bad_input,
                   fmt::format("{}{}: expected an SVG drawing, found: {}", name, line_of(error),
                               shortened(error.what())));
  } catch (const std::exception& error) {
    return failure(ErrorKind::bad_input, fmt::format("{}: expected an SVG drawing, found: {}", name,
                                                     shortened(error.what())));
  }
  Drawing drawing{std::move(collector.lines), false, std::move(shapes->notes)};
  drawing.unit_stated = shapes->unit_stated;
  return drawing;
}

}  // namespace clay::importing
