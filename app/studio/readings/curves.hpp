#pragma once
// Curves for plots: the last seconds of the servo, and any number of points reduced to one column
// per pixel without losing a peak.

#include "app/servo/tick_trace.hpp"

#include <cstddef>
#include <cstdint>
#include <deque>
#include <optional>
#include <span>
#include <vector>

namespace clay::studio {

struct CurvePoint {
  double at = 0.0, value = 0.0;
};
struct MinMax {
  double least = 0.0, most = 0.0;
  friend bool operator==(const MinMax&, const MinMax&) = default;
};

/// Extremes in `columns` equal parts of from..to; empty where there is no point. Points outside are
/// ignored.
[[nodiscard]] std::vector<std::optional<MinMax>> min_max_of(std::span<const CurvePoint> points,
                                                            double from, double to,
                                                            std::size_t columns);

/// The smallest of 1, 2, 5, 10, 20, ... that is at least `value` > 0: the end of an axis.
[[nodiscard]] double round_up(double value);

inline constexpr double kHistoryS = 10.0;

struct TickFigures {
  std::size_t ticks = 0;
  std::uint64_t missed = 0;
  double late_p50_us = 0.0, late_p99_us = 0.0, late_most_us = 0.0;
  double work_p50_us = 0.0, force_most_n = 0.0;
};

class TickHistory {
 public:
  /// Reads all samples of the trace and drops those older than kHistoryS before the newest.
  void take(servo::TickTrace& trace);
  void add(const servo::TickSample& sample);

  [[nodiscard]] bool empty() const noexcept { return samples_.empty(); }
  [[nodiscard]] const std::deque<servo::TickSample>& samples() const noexcept { return samples_; }
  /// Figures of all samples kept. Percentile p of n sorted ticks is number ceil(p n).
  [[nodiscard]] TickFigures figures() const;
  /// A value over the time relative to the newest tick, from -kHistoryS to 0 [s].
  [[nodiscard]] std::vector<CurvePoint> curve(float servo::TickSample::*value) const;

 private:
  std::deque<servo::TickSample> samples_;
};

}  // namespace clay::studio
