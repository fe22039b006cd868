#include "app/chart/chart.hpp"

namespace clay::chart {

std::string svg_of(const Plot& plot, Place place) {
  Extent x{plot.x.logarithmic}, y{plot.y.logarithmic};
  for (const Curve& curve : plot.curves) {
    x.add(curve.x);
    y.add(curve.y);
    y.add(curve.low);
    y.add(curve.high);
  }
  Chart chart(plot.title, plot.x, plot.y, x.scale(plot.x.logarithmic ? 0.05 : 0.0), y.scale(0.06),
              place);
  chart.grid();
  for (std::size_t k = 0; k < plot.curves.size(); ++k) chart.curve(plot.curves[k], k, false);
  return chart.finish();
}

}  // namespace clay::chart
