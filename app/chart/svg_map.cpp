#include "app/chart/chart.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace clay::chart {
namespace {

/// Borders of the cells around ascending centres: midpoints, on the scale of the axis.
std::vector<double> borders(const std::vector<double>& centres, bool logarithmic) {
  std::vector<double> edges;
  if (centres.empty()) return edges;
  const auto to = [&](double v) { return logarithmic ? std::log(v) : v; };
  const auto from = [&](double v) { return logarithmic ? std::exp(v) : v; };
  const std::size_t n = centres.size();
  const double first = n > 1 ? 0.5 * (to(centres[1]) - to(centres[0])) : 0.5;
  const double last = n > 1 ? 0.5 * (to(centres[n - 1]) - to(centres[n - 2])) : 0.5;
  edges.push_back(from(to(centres[0]) - first));
  for (std::size_t k = 0; k + 1 < n; ++k)
    edges.push_back(from(0.5 * (to(centres[k]) + to(centres[k + 1]))));
  edges.push_back(from(to(centres[n - 1]) + last));
  return edges;
}

/// From blue through a pale middle to orange: distinguishable with colour blindness, and by
/// lightness in print.
std::string cell_colour(double bad) {
  constexpr double kGood[] = {0x8f, 0xc3, 0xe6}, kMiddle[] = {0xf4, 0xee, 0xdd},
                   kBad[] = {0xe0, 0x7b, 0x2f};
  const double* const from = bad < 0.5 ? kGood : kMiddle;
  const double* const to = bad < 0.5 ? kMiddle : kBad;
  const double part = bad < 0.5 ? 2.0 * bad : 2.0 * bad - 1.0;
  const auto mix = [&](int i) { return static_cast<int>(from[i] + part * (to[i] - from[i])); };
  return fmt::format("#{:02x}{:02x}{:02x}", mix(0), mix(1), mix(2));
}

std::string rectangle(const char* style, double x, double y, double width, double height,
                      const std::string& colour) {
  SvgWriter svg;
  svg.element("rect", {{"class", style},
                       {"x", fixed(x, 1)},
                       {"y", fixed(y, 1)},
                       {"width", fixed(width, 1)},
                       {"height", fixed(height, 1)},
                       {"fill", colour}});
  return svg.take();
}

std::string cell_svg(double x0, double y0, double x1, double y1, double bad) {
  const double left = std::min(x0, x1), top = std::min(y0, y1);
  const double width = std::abs(x1 - x0), height = std::abs(y1 - y0);
  if (!std::isfinite(bad))
    return rectangle("none", left + 2.0, top + 2.0, std::max(width - 4.0, 0.5),
                     std::max(height - 4.0, 0.5), {});
  bad = std::clamp(bad, 0.0, 1.0);
  SvgWriter svg;
  svg.raw(rectangle("cell", left, top, width, height, cell_colour(bad)));
  // The area also encodes the value, for reading in grey.
  const double radius = 0.32 * std::min(width, height) * std::sqrt(bad);
  if (radius > 0.4)
    svg.element("circle", {{"class", "cell-dot"},
                           {"cx", fixed(left + 0.5 * width, 1)},
                           {"cy", fixed(top + 0.5 * height, 1)},
                           {"r", fixed(radius, 1)}});
  return svg.take();
}

void legend(Chart& chart) {
  const auto symbol = [](double bad) { return cell_svg(-8.0, -8.0, 8.0, 8.0, bad); };
  chart.legend_entry(symbol(0.0), "good");
  chart.legend_entry(symbol(0.5), "between");
  chart.legend_entry(symbol(1.0), "bad");
}

}  // namespace

std::string svg_of(const Map& map, Place place) {
  const auto x_edges = borders(map.x_values, map.x.logarithmic);
  const auto y_edges = borders(map.y_values, map.y.logarithmic);
  Extent x{map.x.logarithmic}, y{map.y.logarithmic};
  x.add(x_edges);
  y.add(y_edges);
  Chart chart(map.title, map.x, map.y, x.scale(0.0), y.scale(0.0), place);
  chart.grid();
  bool gaps = false;
  for (std::size_t row = 0; row < std::min(map.cells.size(), map.y_values.size()); ++row)
    for (std::size_t k = 0; k < std::min(map.cells[row].size(), map.x_values.size()); ++k) {
      const double bad = map.cells[row][k];
      gaps = gaps || !std::isfinite(bad);
      chart.add(cell_svg(chart.x().at(x_edges[k]), chart.y().at(y_edges[row]),
                         chart.x().at(x_edges[k + 1]), chart.y().at(y_edges[row + 1]), bad));
    }
  legend(chart);
  if (gaps) chart.legend_entry(cell_svg(-8.0, -8.0, 8.0, 8.0, std::nan("")), "not measured");
  for (std::size_t k = 0; k < map.curves.size(); ++k) chart.curve(map.curves[k], k, true);
  return chart.finish();
}

}  // namespace clay::chart
