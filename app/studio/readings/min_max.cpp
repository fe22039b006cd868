#include "app/studio/readings/min_max.hpp"

#include <algorithm>
#include <cmath>

namespace clay::studio {

std::vector<std::optional<MinMax>> min_max_of(std::span<const CurvePoint> points, double from,
                                              double to, std::size_t columns) {
  std::vector<std::optional<MinMax>> parts(columns);
  if (!(to > from) || columns == 0) return parts;
  const double scale = static_cast<double>(columns) / (to - from);
  for (const CurvePoint& point : points) {
    if (!(point.at >= from && point.at <= to)) continue;
    const auto column = std::min(static_cast<std::size_t>((point.at - from) * scale), columns - 1);
    std::optional<MinMax>& part = parts[column];
    if (!part) part = MinMax{point.value, point.value};
    part->least = std::min(part->least, point.value);
    part->most = std::max(part->most, point.value);
  }
  return parts;
}

double round_up(double value) {
  const double decade = std::pow(10.0, std::floor(std::log10(value)));
  for (const double step : {1.0, 2.0, 5.0})
    if (value <= step * decade * (1.0 + 1e-12)) return step * decade;
  return 10.0 * decade;
}

}  // namespace clay::studio
