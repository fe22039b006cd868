#pragma once
// What repetitions say: their median, and how far the middle half of them spreads.

#include <vector>

namespace clay::bench {

/// Median and quartiles. Of nothing: NaN.
struct Spread {
  double low = 0.0;  ///< a quarter of the repetitions lies below
  double median = 0.0;
  double high = 0.0;                                         ///< a quarter lies above
  [[nodiscard]] double range() const { return high - low; }  ///< interquartile range
};

/// The value below which `fraction` (0..1) of the samples lie, interpolated between the two nearest
/// (Hyndman and Fan, The American Statistician 50(4) 1996, definition 7). NaN of no samples.
[[nodiscard]] double quantile(std::vector<double> samples, double fraction);
[[nodiscard]] Spread spread_of(const std::vector<double>& samples);

/// Of a[k] / b[k], as long as both go on: taken round by round, a noisy moment hits both alike.
[[nodiscard]] Spread ratio_of(const std::vector<double>& a, const std::vector<double>& b);

/// A requirement on a noisy median is missed where three quarters of the repetitions miss it.
[[nodiscard]] inline bool exceeds(const Spread& measured, double limit) {
  return measured.low > limit;
}
[[nodiscard]] inline bool falls_short(const Spread& measured, double limit) {
  return measured.high < limit;
}

}  // namespace clay::bench
