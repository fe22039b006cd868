#include "export/smoothing/volume_correction.hpp"

#include "core/compensated_sum.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace clay::solid::inline smoothing {

double swept_over_pi(const Polygon& line) noexcept {
  CompensatedSum sum;
  for (std::size_t i = 0; i + 1 < line.size(); ++i) {
    const double a = line[i].rho, b = line[i + 1].rho;
    sum.add((line[i + 1].y - line[i].y) * (a * a + a * b + b * b));
  }
  return sum.value() / 3.0;
}

double scale_for(const Polygon& line, const std::vector<double>& weights,
                 double wanted_over_pi) noexcept {
  CompensatedSum linear, square;
  for (std::size_t i = 0; i + 1 < line.size(); ++i) {
    const double dy = line[i + 1].y - line[i].y, a = line[i].rho, b = line[i + 1].rho;
    const double moved_a = weights[i] * a, moved_b = weights[i + 1] * b;
    linear.add(dy * (2.0 * a * moved_a + a * moved_b + b * moved_a + 2.0 * b * moved_b));
    square.add(dy * (moved_a * moved_a + moved_a * moved_b + moved_b * moved_b));
  }
  const double lacking = 3.0 * (wanted_over_pi - swept_over_pi(line));
  const double under_root = linear.value() * linear.value() + 4.0 * square.value() * lacking;
  if (!(linear.value() > 0.0) || under_root < 0.0) return 0.0;
  return 2.0 * lacking / (linear.value() + std::sqrt(under_root));
}

double scale(Polygon& line, const std::vector<double>& weights, double share) noexcept {
  double most = 0.0;
  for (std::size_t i = 0; i < line.size(); ++i) {
    const double move = line[i].rho * weights[i] * share;
    line[i].rho += move;
    most = std::max(most, std::abs(move));
  }
  return most;
}

}  // namespace clay::solid::inline smoothing
