#pragma once
#include "app/cli/replay.hpp"

#include <cstddef>
#include <string>
#include <vector>

namespace clay::cli {

struct ErrorCurve {
  std::string model;
  std::vector<TraceRow> rows;
};

/// Keeps the rows of a curve in bounded memory: all of some hundred thousand ticks; above that, the
/// rows with the smallest and the largest error of each short run of ticks.
class ErrorRows {
 public:
  explicit ErrorRows(std::size_t ticks) : run_(ticks / kMostRuns + 1) {}
  void add(const TraceRow& row);
  [[nodiscard]] std::vector<TraceRow> take();

 private:
  static constexpr std::size_t kMostRuns = std::size_t{1} << 19;
  void close();

  std::size_t run_, in_run_ = 0;
  TraceRow low_, high_;
  bool low_first_ = true;
  std::vector<TraceRow> rows_;
};

/// Volume error in percent of the initial volume over time, as in the paper's figure 7, with the
/// paper's bound Delta v_N. Standalone SVG; curves are thinned to the extremes of each column.
std::string error_plot_svg(const std::string& title, const std::vector<ErrorCurve>& curves);

}  // namespace clay::cli
