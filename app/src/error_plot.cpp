#include "error_plot.hpp"

#include "plot/plot.hpp"

namespace clay::app {

std::string error_plot_svg(const std::string& title, const std::vector<ErrorCurve>& curves) {
  plot::Plot plot;
  plot.title = std::string("Volume error while throwing: ").append(title);
  plot.x.label = "time [s]";
  plot.y.label = "error [% of the initial volume]";
  for (const ErrorCurve& source : curves) {
    plot::Curve curve, bound;
    curve.name = std::string("model ").append(source.model);
    bound.name = "the paper's bound, one top ring";
    bound.dashed = true;
    for (const TraceRow& row : source.rows) {
      curve.x.push_back(row.time_s);
      curve.y.push_back(row.volume_error_percent);
      bound.y.push_back(-row.top_ring_percent);
    }
    bound.x = curve.x;
    plot.curves.push_back(std::move(curve));
    if (source.model == "paper") plot.curves.push_back(std::move(bound));
  }
  return svg_of(plot, plot::Place::alone);
}

}  // namespace clay::app
