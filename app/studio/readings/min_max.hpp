#pragma once
// Curves of any number of points in as many columns as there are pixels: nothing that stands out is
// lost.

#include <cstddef>
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

/// `columns` equal parts of from..to; nothing where no point lies. Points outside are left out.
[[nodiscard]] std::vector<std::optional<MinMax>> min_max_of(std::span<const CurvePoint> points,
                                                            double from, double to,
                                                            std::size_t columns);

/// The next of 1, 2, 5, 10, 20, ... that is no less than `value` > 0: the top of an axis.
[[nodiscard]] double round_up(double value);

}  // namespace clay::studio
