#include "app/chart/chart.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

namespace clay::chart {
namespace {

constexpr double kHeight = 340.0;  // of the frame
constexpr std::size_t kColours = 7;
constexpr std::size_t kMostMarks = 60;  // above this number of points only the line is drawn
constexpr std::size_t kUnthinned = 2000;
// Upper estimates, of texts of 13 and of 10 px.
constexpr double kPxPerLetter = 7.3, kPxPerSmallLetter = 5.8;
constexpr double kRow = 21.0;  // of the legend

/// Marks of about equal area, around (0, 0).
constexpr const char* kMarks[] = {"M-3.6 0a3.6 3.6 0 1 0 7.2 0a3.6 3.6 0 1 0 -7.2 0Z",
                                  "M-3.2 -3.2H3.2V3.2H-3.2Z",
                                  "M0 -4.6L4.2 3H-4.2Z",
                                  "M0 -4.6L4.6 0 0 4.6 -4.6 0Z",
                                  "M0 4.6L4.2 -3H-4.2Z",
                                  "M-1.3 -4.2H1.3V-1.3H4.2V1.3H1.3V4.2H-1.3V1.3H-4.2V-1.3H-1.3Z",
                                  "M-4.6 -3.2L0 -1 4.6 -3.2 0 4.6Z"};
constexpr const char* kZeroMark = "M0 1L4.6 -7H-4.6Z";

std::string px(double length) { return fixed(length, 1); }

std::string moved(double x, double y) { return fmt::format("translate({:.1f} {:.1f})", x, y); }

const char* dashes(bool dashed) { return dashed ? "6 4" : ""; }

void mark(SvgWriter& svg, const char* shape, double x, double y, const std::string& classes) {
  svg.element("path", {{"class", classes}, {"transform", moved(x, y)}, {"d", shape}});
}

void text(SvgWriter& svg, double x, double y, const char* anchor, std::string_view words) {
  svg.element("text", {{"x", px(x)}, {"y", px(y)}, {"text-anchor", anchor}}, words);
}

std::size_t letters(std::string_view text) {
  return static_cast<std::size_t>(std::count_if(text.begin(), text.end(), [](char c) {
    return (static_cast<unsigned char>(c) & 0xC0) != 0x80;
  }));
}

std::string colour(std::size_t number, bool on_map, const char* stroke_or_fill) {
  if (on_map) return stroke_or_fill[0] == 's' ? "on-map" : "fill-ink";
  return stroke_or_fill + std::to_string(number % kColours);
}

}  // namespace

Chart::Chart(std::string_view title, const Axis& x_axis, const Axis& y_axis, AxisScale x,
             AxisScale y, Place place)
    : x_(std::move(x)),
      y_(std::move(y)),
      x_label_(x_axis.label),
      y_label_(y_axis.label),
      title_(title),
      place_(place),
      top_(place == Place::alone ? 44.0 : 12.0),
      bottom_(top_ + kHeight),
      placer_({left_, top_, right_, bottom_}) {
  x_.place(left_, right_);
  y_.place(bottom_, top_);
}

void Chart::grid() {
  for (const Tick& tick : x_.ticks()) {
    const double at = x_.at(tick.value);
    body_.element("path", {{"class", tick.label.empty() ? "minor" : "grid"},
                           {"d", fmt::format("M{:.1f} {:.1f}V{:.1f}", at, top_, bottom_)}});
    if (!tick.label.empty()) text(body_, at, bottom_ + 19.0, "middle", tick.label);
  }
  for (const Tick& tick : y_.ticks()) {
    const double at = y_.at(tick.value);
    body_.element("path", {{"class", tick.label.empty() ? "minor" : "grid"},
                           {"d", fmt::format("M{:.1f} {:.1f}H{:.1f}", left_, at, right_)}});
    if (!tick.label.empty()) text(body_, left_ - 8.0, at + 4.5, "end", tick.label);
  }
  body_.element("rect", {{"class", "box"},
                         {"x", px(left_)},
                         {"y", px(top_)},
                         {"width", px(right_ - left_)},
                         {"height", px(bottom_ - top_)}});
  text(body_, 0.5 * (left_ + right_), bottom_ + 42.0, "middle", x_label_);
  body_.element("text",
                {{"transform", moved(18.0, 0.5 * (top_ + bottom_)) + " rotate(-90)"},
                 {"text-anchor", "middle"}},
                y_label_);
}

std::vector<Chart::Point> Chart::points_of(const std::vector<double>& x,
                                           const std::vector<double>& y) const {
  std::vector<Point> points;
  const std::size_t count = std::min(x.size(), y.size());
  for (std::size_t k = 0; k < count; ++k) {
    const bool zero = y_.logarithmic() && y[k] == 0.0;
    if (x_.shows(x[k]) && (zero || y_.shows(y[k])))
      points.push_back({x_.at(x[k]), zero ? bottom_ : y_.at(y[k]), zero});
    else
      points.push_back({std::nan(""), 0.0, false});  // a gap in the line
  }
  if (count <= kUnthinned) return points;
  std::vector<Point> thinned;
  for (std::size_t k = 0; k < count;) {
    std::size_t end = k + 1;
    while (end < count && std::floor(2.0 * points[end].x) == std::floor(2.0 * points[k].x)) ++end;
    const auto first = points.begin() + static_cast<std::ptrdiff_t>(k),
               last = points.begin() + static_cast<std::ptrdiff_t>(end);
    auto [low, high] =
        std::minmax_element(first, last, [](const Point& a, const Point& b) { return a.y < b.y; });
    if (high < low) std::swap(low, high);
    thinned.push_back(*low);
    if (high != low) thinned.push_back(*high);
    k = end;
  }
  return thinned;
}

void Chart::spread(const Curve& curve, std::size_t number) {
  std::string bars;
  std::size_t count = 0;
  const auto add = [&](const std::vector<Point>& low, const std::vector<Point>& high, auto bar) {
    for (std::size_t k = 0; k < std::min(low.size(), high.size()); ++k)
      if (std::isfinite(low[k].x) && std::isfinite(high[k].x))
        bars += bar(low[k], high[k]), ++count;
  };
  add(points_of(curve.x, curve.low), points_of(curve.x, curve.high),
      [](const Point& low, const Point& high) {
        return fmt::format("M{:.1f} {:.1f}h6m-3 0V{:.1f}m-3 0h6", low.x - 3.0, low.y, high.y);
      });
  add(points_of(curve.x_low, curve.y), points_of(curve.x_high, curve.y),
      [](const Point& low, const Point& high) {
        return fmt::format("M{:.1f} {:.1f}v6m0 -3H{:.1f}m0 -3v6", low.x, low.y - 3.0, high.x);
      });
  if (!bars.empty() && count <= kMostMarks)
    body_.element("path", {{"class", fmt::format("bar s{}", number % kColours)}, {"d", bars}});
}

void Chart::keep_labels(const Curve& curve, const std::vector<Point>& points, std::size_t number) {
  for (std::size_t k = 0; k < std::min(points.size(), curve.labels.size()); ++k)
    if (std::isfinite(points[k].x))
      labels_.push_back({{points[k].x, points[k].y}, curve.labels[k], number});
}

void Chart::draw_labels() {
  for (const Label& label : labels_) placer_.avoid_mark(label.at);
  for (const Label& label : labels_) {
    const double width = kPxPerSmallLetter * static_cast<double>(letters(label.words));
    const auto [at, anchor] = placer_.place(label.at, width);
    body_.element("text",
                  {{"class", fmt::format("label f{}", label.number % kColours)},
                   {"x", px(at.x)},
                   {"y", px(at.y)},
                   {"text-anchor", anchor}},
                  label.words);
  }
}

void Chart::line(const std::vector<Point>& points, const std::string& classes, bool dashed) {
  std::string path;
  bool down = false;
  Spot last;
  for (const Point& p : points) {
    const bool drawn = std::isfinite(p.x) && !p.zero;
    if (drawn) path += fmt::format("{}{:.1f} {:.2f}", down ? "L" : "M", p.x, p.y);
    if (drawn && down) placer_.avoid_line(last, {p.x, p.y});
    last = {p.x, p.y};
    down = drawn;
  }
  if (!path.empty())
    body_.element(
        "path", {{"class", "line " + classes}, {"stroke-dasharray", dashes(dashed)}, {"d", path}});
}

void Chart::marks(const std::vector<Point>& points, std::size_t number, bool on_map) {
  for (const Point& p : points) {
    if (!std::isfinite(p.x)) continue;
    zeros_ = zeros_ || p.zero;
    if (p.zero)
      mark(body_, kZeroMark, p.x, p.y, "zero " + colour(number, on_map, "s"));
    else
      mark(body_, kMarks[number % std::size(kMarks)], p.x, p.y,
           "mark " + colour(number, on_map, "f"));
  }
}

void Chart::curve(const Curve& curve, std::size_t number, bool on_map) {
  const auto points = points_of(curve.x, curve.y);
  const std::string stroke = colour(number, on_map, "s");
  // A nested SVG clips at its frame without needing an id.
  const double width = right_ - left_, height = bottom_ - top_;
  body_.open("svg",
             {{"x", px(left_)},
              {"y", px(top_)},
              {"width", px(width)},
              {"height", px(height)},
              {"viewBox", fmt::format("{:.1f} {:.1f} {:.1f} {:.1f}", left_, top_, width, height)}});
  if (!on_map) spread(curve, number);
  if (curve.line && on_map) line(points, "under", false);
  if (curve.line) line(points, stroke, curve.dashed);
  body_.close("svg");
  const bool marked = !curve.line || (!on_map && !curve.dashed && points.size() <= kMostMarks);
  if (marked) marks(points, number, on_map);
  keep_labels(curve, points, number);
  if (curve.name.empty()) return;
  // On a map, black is drawn on a pale background here as well.
  SvgWriter symbol;
  if (on_map)
    symbol.element(
        "rect", {{"class", "pale"}, {"x", "-15"}, {"y", "-8"}, {"width", "30"}, {"height", "16"}});
  if (curve.line)
    symbol.element("path", {{"class", "line " + stroke},
                            {"stroke-dasharray", dashes(curve.dashed)},
                            {"d", "M-13 0H13"}});
  if (marked)
    mark(symbol, kMarks[number % std::size(kMarks)], 0, 0, "mark " + colour(number, on_map, "f"));
  legend_entry(symbol.take(), curve.name);
}

void Chart::legend_entry(const std::string& symbol, const std::string& words) {
  legend_.emplace_back(symbol, words);
}

std::string Chart::finish() {
  draw_labels();
  if (zeros_) {
    SvgWriter symbol;
    mark(symbol, kZeroMark, 0, 3, "zero s5");
    legend_entry(symbol.take(), "on the axis: exactly 0");
  }
  double x = left_, y = bottom_ + 68.0;
  for (const auto& [symbol, words] : legend_) {
    const double width = 40.0 + kPxPerLetter * static_cast<double>(letters(words));
    if (x > left_ && x + width > right_ + 10.0) {
      x = left_;
      y += kRow;
    }
    body_.open("g", {{"transform", moved(x + 13.0, y - 4.5)}});
    body_.raw(symbol);
    body_.close("g");
    text(body_, x + 32.0, y, "start", words);
    x += width + 12.0;
  }
  const double height = legend_.empty() ? bottom_ + 54.0 : y + 14.0;
  return page(height);
}

/// The whole drawing, with its own style if it stands alone.
std::string Chart::page(double height) {
  const std::string width = fixed(kWidth, 0), high = fixed(height, 0);
  SvgWriter svg;
  svg.open("svg", {{"class", "plot"},
                   {"xmlns", "http://www.w3.org/2000/svg"},
                   {"viewBox", "0 0 " + width + " " + high},
                   {"width", width},
                   {"height", high},
                   {"role", "img"},
                   {"aria-label", title_}});
  if (place_ == Place::alone) {
    svg.raw(std::string("<style>").append(style()).append("</style>\n"));
    svg.element("rect", {{"class", "back"}, {"width", width}, {"height", high}});
    svg.element("text", {{"class", "name"}, {"x", fixed(left_, 0)}, {"y", "24"}}, title_);
  }
  svg.raw(body_.take());
  svg.close("svg");
  return svg.take();
}

}  // namespace clay::chart
