#pragma once
#include <string>
#include <vector>

namespace clay::chart {

struct Tick {
  double value = 0.0;
  std::string label;  ///< empty for a line of the minor grid
};

/// Maps the values of an axis to px, linear or logarithmic.
class AxisScale {
 public:
  /// `low` and `high` are finite, and positive for logarithmic axes; an empty or reversed range is
  /// widened.
  AxisScale(bool logarithmic, double low, double high);

  void place(double low_px, double high_px);
  [[nodiscard]] double at(double value) const;  ///< [px]
  /// Finite, and on a logarithmic axis above 0.
  [[nodiscard]] bool shows(double value) const;
  [[nodiscard]] bool logarithmic() const { return logarithmic_; }
  [[nodiscard]] double low() const { return low_; }
  [[nodiscard]] double high() const { return high_; }

  /// Ticks at round values within the range; on a logarithmic axis at decades, with labels between
  /// them if there are few.
  [[nodiscard]] std::vector<Tick> ticks() const;

 private:
  [[nodiscard]] std::vector<Tick> linear_ticks() const;
  [[nodiscard]] std::vector<Tick> decade_ticks() const;
  bool logarithmic_;
  double low_, high_;
  double low_px_ = 0.0, high_px_ = 1.0;
};

/// The smallest of 1, 2, 5 times a power of ten that divides `range` into at most `parts`.
[[nodiscard]] double round_step(double range, double parts);

/// A range that grows to include added values.
struct Extent {
  bool logarithmic = false;
  double low = 0.0, high = 0.0;
  bool empty = true;
  void add(double value);
  void add(const std::vector<double>& values);
  /// Widened by a fraction of its length at both ends; 0 to 1 (1 to 10) if empty.
  [[nodiscard]] AxisScale scale(double margin) const;
};

}  // namespace clay::chart
