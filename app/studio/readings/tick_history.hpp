#pragma once
// The last seconds of the servo, tick by tick, on its own clock.

#include "app/servo/tick_trace.hpp"
#include "app/studio/readings/min_max.hpp"

#include <cstdint>
#include <deque>
#include <vector>

namespace clay::studio {

inline constexpr double kHistoryS = 10.0;

struct TickFigures {
  std::size_t ticks = 0;
  std::uint64_t missed = 0;
  double late_p50_us = 0.0, late_p99_us = 0.0, late_most_us = 0.0;
  double work_p50_us = 0.0, force_most_n = 0.0;
};

class TickHistory {
 public:
  /// Takes what the trace holds; forgets what is older than kHistoryS before the newest.
  void take(servo::TickTrace& trace);
  void add(const servo::TickSample& sample);

  [[nodiscard]] bool empty() const noexcept { return samples_.empty(); }
  [[nodiscard]] const std::deque<servo::TickSample>& samples() const noexcept { return samples_; }
  /// Of all that is remembered. Percentiles: of n ticks in order, number ceil(p n).
  [[nodiscard]] TickFigures figures() const;
  /// Seconds before the newest tick, from -kHistoryS to 0, against a value.
  [[nodiscard]] std::vector<CurvePoint> curve(float servo::TickSample::*value) const;

 private:
  std::deque<servo::TickSample> samples_;
};

}  // namespace clay::studio
