#include "app/bench/statistics.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>

namespace clay::bench {

double quantile(std::vector<double> samples, double fraction) {
  if (samples.empty()) return std::numeric_limits<double>::quiet_NaN();
  const double at = std::clamp(fraction, 0.0, 1.0) * static_cast<double>(samples.size() - 1);
  const auto below = samples.begin() + static_cast<std::ptrdiff_t>(at);
  std::nth_element(samples.begin(), below, samples.end());
  const double part = at - std::floor(at);
  if (part == 0.0) return *below;
  return *below + part * (*std::min_element(below + 1, samples.end()) - *below);
}

Spread spread_of(const std::vector<double>& samples) {
  return {quantile(samples, 0.25), quantile(samples, 0.5), quantile(samples, 0.75)};
}

Spread ratio_of(const std::vector<double>& a, const std::vector<double>& b) {
  std::vector<double> ratios;
  for (std::size_t k = 0; k < std::min(a.size(), b.size()); ++k) ratios.push_back(a[k] / b[k]);
  return spread_of(ratios);
}

}  // namespace clay::bench
