#include "app/cli/error_plot.hpp"

#include "app/chart/plot.hpp"

#include <utility>

namespace clay::cli {

void ErrorRows::add(const TraceRow& row) {
  if (in_run_ == 0) {
    low_ = high_ = row;
  } else if (row.volume_error_percent < low_.volume_error_percent) {
    low_ = row;
    low_first_ = false;
  } else if (row.volume_error_percent > high_.volume_error_percent) {
    high_ = row;
    low_first_ = true;
  }
  if (++in_run_ == run_) close();
}

void ErrorRows::close() {
  if (in_run_ == 0) return;
  rows_.push_back(low_first_ ? low_ : high_);
  if (low_.time_s != high_.time_s) rows_.push_back(low_first_ ? high_ : low_);
  in_run_ = 0;
}

std::vector<TraceRow> ErrorRows::take() {
  close();
  return std::move(rows_);
}

std::string error_plot_svg(const std::string& title, const std::vector<ErrorCurve>& curves) {
  chart::Plot plot;
  plot.title = std::string("Volume error while throwing: ").append(title);
  plot.x.label = "time [s]";
  plot.y.label = "error [% of the initial volume]";
  for (const ErrorCurve& source : curves) {
    chart::Curve curve, bound;
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
  return svg_of(plot, chart::Place::alone);
}

}  // namespace clay::cli
