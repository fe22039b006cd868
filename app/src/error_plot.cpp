#include "error_plot.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <string_view>

namespace clay::app {
namespace {

constexpr double kWidth = 760, kHeight = 380, kLeft = 70, kRight = 20, kTop = 48, kBottom = 56;
constexpr const char* kColours[] = {"#b3541e", "#1f6f8b"};

/// A round step that gives four to eight ticks.
double tick_step(double range) {
  const double raw = range / 5.0, power = std::pow(10.0, std::floor(std::log10(raw)));
  for (const double factor : {1.0, 2.0, 5.0})
    if (factor * power >= raw) return factor * power;
  return 10.0 * power;
}

struct Axes {
  double time_s, low, high;
  [[nodiscard]] double x(double t) const { return kLeft + (kWidth - kLeft - kRight) * t / time_s; }
  [[nodiscard]] double y(double v) const {
    return kTop + (kHeight - kTop - kBottom) * (high - v) / (high - low);
  }
};

Axes axes_for(const std::vector<ErrorCurve>& curves) {
  Axes axes{1e-3, 0.0, 0.0};
  for (const ErrorCurve& curve : curves)
    for (const TraceRow& row : curve.rows) {
      axes.time_s = std::max(axes.time_s, row.time_s);
      axes.low = std::min({axes.low, row.volume_error_percent, -row.top_ring_percent});
      axes.high = std::max(axes.high, row.volume_error_percent);
    }
  const double step = tick_step(std::max(axes.high - axes.low, 1e-6));
  axes.low = step * std::floor(axes.low / step);
  axes.high = step * (std::floor(axes.high / step) + 0.5);
  return axes;
}

std::string grid(const Axes& axes) {
  std::string svg;
  const double dy = tick_step(axes.high - axes.low), dt = tick_step(axes.time_s);
  for (double v = axes.low; v <= axes.high + 1e-9; v += dy)
    svg += fmt::format(
        "<path d='M{:.1f} {:.1f}H{:.1f}' stroke='#ddd'/><text x='{:.1f}' y='{:.1f}' "
        "text-anchor='end'>{:.3g}</text>\n",
        kLeft, axes.y(v), kWidth - kRight, kLeft - 8, axes.y(v) + 4, std::abs(v) < 1e-9 ? 0.0 : v);
  for (double t = 0.0; t <= axes.time_s + 1e-9; t += dt)
    svg += fmt::format(
        "<path d='M{:.1f} {:.1f}v5' stroke='#888'/><text x='{:.1f}' y='{:.1f}' "
        "text-anchor='middle'>{:g}</text>\n",
        axes.x(t), kHeight - kBottom, axes.x(t), kHeight - kBottom + 20, t);
  return svg;
}

/// First, least and greatest of every half pixel: nothing that the eye could see is lost.
template <class Value>
std::string curve_path(const Axes& axes, const std::vector<TraceRow>& rows, Value value) {
  std::string path;
  const auto point = [&](const TraceRow& row) {
    path += fmt::format("{}{:.1f} {:.2f}", path.empty() ? "M" : "L", axes.x(row.time_s),
                        axes.y(value(row)));
  };
  for (std::size_t k = 0; k < rows.size();) {
    const double column = std::floor(2.0 * axes.x(rows[k].time_s));
    std::size_t end = k;
    while (end < rows.size() && std::floor(2.0 * axes.x(rows[end].time_s)) == column) ++end;
    const auto first = rows.begin() + static_cast<std::ptrdiff_t>(k),
               last = rows.begin() + static_cast<std::ptrdiff_t>(end);
    auto [low, high] = std::minmax_element(
        first, last, [&](const TraceRow& a, const TraceRow& b) { return value(a) < value(b); });
    if (high < low) std::swap(low, high);
    point(*low);
    if (high != low) point(*high);
    k = end;
  }
  return path;
}

std::string legend(double x, const char* colour, const char* dash, const std::string& text) {
  return fmt::format(
      "<path d='M{:.0f} {:.0f}h26' stroke='{}' stroke-width='2' stroke-dasharray='{}'/><text "
      "x='{:.0f}' y='{:.0f}'>{}</text>\n",
      x, kTop - 12, colour, dash, x + 32, kTop - 8, text);
}

}  // namespace

std::string error_plot_svg(const std::string& title, const std::vector<ErrorCurve>& curves) {
  const Axes axes = axes_for(curves);
  std::string svg = fmt::format(
      "<svg xmlns='http://www.w3.org/2000/svg' viewBox='0 0 {0} {1}' width='{0}' height='{1}' "
      "font-family='sans-serif' font-size='13' fill='#333'>\n"
      "<rect width='{0}' height='{1}' fill='#fff'/>\n<text x='{2}' y='20' font-size='15' "
      "font-weight='bold'>Volume error while throwing: {3}</text>\n",
      kWidth, kHeight, kLeft, title);
  svg += grid(axes);
  double legend_x = kLeft;
  for (std::size_t c = 0; c < curves.size(); ++c) {
    const char* colour = kColours[c % std::size(kColours)];
    svg += fmt::format(
        "<path d='{}' fill='none' stroke='{}' stroke-width='1.6'/>\n",
        curve_path(axes, curves[c].rows, [](const TraceRow& r) { return r.volume_error_percent; }),
        colour);
    svg += legend(legend_x, colour, "none", "model " + curves[c].model);
    legend_x += 190;
    if (curves[c].model != "paper") continue;
    svg += fmt::format(
        "<path d='{}' fill='none' stroke='{}' stroke-dasharray='4 3' opacity='0.7'/>\n",
        curve_path(axes, curves[c].rows, [](const TraceRow& r) { return -r.top_ring_percent; }),
        colour);
    svg += legend(legend_x, colour, "4 3", "the paper's bound, one top ring");
    legend_x += 250;
  }
  svg += fmt::format(
      "<text x='{:.0f}' y='{:.0f}' text-anchor='middle'>time [s]</text>\n"
      "<text transform='translate(18 {:.0f}) rotate(-90)' text-anchor='middle'>error [% of the "
      "initial volume]</text>\n</svg>\n",
      0.5 * (kLeft + kWidth - kRight), kHeight - 12, 0.5 * (kTop + kHeight - kBottom));
  return svg;
}

}  // namespace clay::app
