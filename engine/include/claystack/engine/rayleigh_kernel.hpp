#pragma once
#include "claystack/engine/quanta.hpp"

#include <cstddef>
#include <cstdint>
#include <vector>

namespace clay {

/// The discrete Rayleigh distribution P_d(j), j = 1..L1 (paper, section 5.1), tabled as integers
/// so that shares of an integer amount add up to it exactly.
class RayleighKernel {
 public:
  /// Q_p(x) = x / sigma^2 exp(-x^2 / 2 sigma^2) at x = h j, for L1 = round(reach / h) rings, at
  /// most `max_rings`. sigma = 0 puts all into j = 1; sigma = inf makes the weights linear in j;
  /// reach = 0 leaves no ring at all, so that everything goes into height.
  RayleighKernel(double sigma_mm, double reach_mm, double ring_height_mm, std::size_t max_rings);

  [[nodiscard]] std::size_t length() const noexcept { return cumulative_.size() - 1; }  ///< L1

  /// What ring j (1..L1) gets of `amount` >= 0, to the quantum; summed over 1..L1 it is `amount`.
  [[nodiscard]] WideQuanta share(WideQuanta amount, std::size_t j) const noexcept {
    return part(amount, cumulative_[j]) - part(amount, cumulative_[j - 1]);
  }

  /// P_d(j), for reports and tests.
  [[nodiscard]] double weight(std::size_t j) const noexcept;

 private:
  // 40 bits of fraction: 2^24 rings of 2^61 quanta times 2^40 still fit 127 bits.
  static constexpr int kFractionBits = 40;
  static WideQuanta part(WideQuanta amount, std::int64_t fraction) noexcept {
    return (amount * fraction) >> kFractionBits;
  }
  std::vector<std::int64_t> cumulative_;  ///< C_0 = 0 .. C_L1 = 2^40
};

}  // namespace clay
