#pragma once
// Intervals of settings, for readers and for messages.

#include <string>

namespace clay {

/// An interval with readable bounds: `from(0).to(5)`, `above(0).to(5000)`, `from(0).below(1)`.
struct Range {
  double low = 0.0;
  double high = 0.0;
  bool low_open = false;
  bool high_open = false;

  [[nodiscard]] constexpr Range to(double end) const { return {low, end, low_open, false}; }
  [[nodiscard]] constexpr Range below(double end) const { return {low, end, low_open, true}; }
  [[nodiscard]] constexpr bool holds(double value) const {
    return (low_open ? value > low : value >= low) && (high_open ? value < high : value <= high);
  }
  /// "from 0 to below 1"
  [[nodiscard]] std::string text() const;
};

constexpr Range from(double start) { return {start, start, false, false}; }
constexpr Range above(double start) { return {start, start, true, false}; }

}  // namespace clay
