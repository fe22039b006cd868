#include "engine/tick/rayleigh_kernel.hpp"

#include "engine/clay/portable_math.hpp"

#include <algorithm>

namespace clay {
namespace {

std::size_t kernel_length(double reach_mm, double ring_height_mm, std::size_t max_rings) {
  const double rings = reach_mm / ring_height_mm + 0.5;
  if (!(rings < static_cast<double>(max_rings))) return max_rings;
  return static_cast<std::size_t>(std::max(rings, 0.0));
}

/// Q_p(h j) relative to Q_p(h): never 0/0, for any sigma.
double relative_weight(double j, double half_h2_per_sigma2) {
  if (j == 1.0) return 1.0;
  return j * (1.0 - one_minus_exp_neg((j * j - 1.0) * half_h2_per_sigma2));
}

}  // namespace

RayleighKernel::RayleighKernel(double sigma_mm, double reach_mm, double ring_height_mm,
                               std::size_t max_rings) {
  const std::size_t length = kernel_length(reach_mm, ring_height_mm, max_rings);
  const double ratio = ring_height_mm / sigma_mm;  // +inf for sigma = 0
  const double exponent = 0.5 * ratio * ratio;
  double total = 0.0;
  for (std::size_t j = 1; j <= length; ++j)
    total += relative_weight(static_cast<double>(j), exponent);

  constexpr double kOne = static_cast<double>(std::int64_t{1} << kFractionBits);
  cumulative_.assign(length + 1, 0);
  double sum = 0.0;
  for (std::size_t j = 1; j <= length; ++j) {
    sum += relative_weight(static_cast<double>(j), exponent);
    // Summed in the order of `total`, so the last quotient is 1 and C_L1 is exactly 2^40.
    cumulative_[j] = static_cast<std::int64_t>(sum / total * kOne + 0.5);
  }
  const auto all = std::lower_bound(cumulative_.begin(), cumulative_.end(), cumulative_.back());
  effective_length_ = static_cast<std::size_t>(all - cumulative_.begin());
}

}  // namespace clay
