#pragma once
// Statistics of repetitions: median and interquartile range.

#include <vector>

namespace clay::bench {

/// Median and quartiles. NaN without samples.
struct Spread {
  double low = 0.0;  ///< a quarter of the repetitions lies below
  double median = 0.0;
  double high = 0.0;                                         ///< a quarter lies above
  [[nodiscard]] double range() const { return high - low; }  ///< interquartile range
};

/// The value below which `fraction` (0..1) of the samples lie, interpolated between the two nearest
/// (Hyndman and Fan, The American Statistician 50(4) 1996, definition 7). NaN without samples.
[[nodiscard]] double quantile(std::vector<double> samples, double fraction);
[[nodiscard]] Spread spread_of(const std::vector<double>& samples);

/// Of a[k] / b[k] for the common length: round by round, so that noise affects both.
[[nodiscard]] Spread ratio_of(const std::vector<double>& a, const std::vector<double>& b);

/// A counted value: it has no spread.
[[nodiscard]] inline Spread counted(double value) { return {value, value, value}; }

}  // namespace clay::bench
