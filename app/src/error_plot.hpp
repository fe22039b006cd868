#pragma once
#include "replay.hpp"

#include <string>
#include <vector>

namespace clay::app {

struct ErrorCurve {
  std::string model;
  std::vector<TraceRow> rows;
};

/// Volume error in percent of the initial volume over time, as in the paper's figure 7, with the
/// paper's bound Delta v_N. Self-contained SVG; curves are thinned to the extremes of each column.
std::string error_plot_svg(const std::string& title, const std::vector<ErrorCurve>& curves);

}  // namespace clay::app
