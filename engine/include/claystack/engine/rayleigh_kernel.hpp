#pragma once
#include "claystack/engine/quanta.hpp"

#include <algorithm>
#include <cmath>
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

  /// Deals an amount out to the rings 1, 2, .. in their order, to the quantum: what rings 1..L1 get
  /// adds up to it. `offset` (in ring heights, at least -1) moves all rings away from the tool:
  /// ring j then gets what lies between j - 1 + offset and j + offset in a distribution that is
  /// even within each ring of the table, ring 1 also what lies before it. A negative offset leaves
  /// something to ring L1 + 1.
  class Dealer {
   public:
    Dealer(const RayleighKernel& kernel, WideQuanta amount, double offset = 0.0) noexcept
        : kernel_(&kernel),
          at_(static_cast<std::int64_t>(std::floor(offset))),
          between_(static_cast<std::int64_t>((offset - std::floor(offset)) * kBetweenOne)),
          amount_(amount) {}
    /// The share of the next ring.
    WideQuanta next() noexcept {
      const WideQuanta before = dealt_;
      ++at_;
      dealt_ = part(amount_, reached());
      return dealt_ - before;
    }

   private:
    static constexpr int kBetweenBits = 20;
    static constexpr double kBetweenOne = 1 << kBetweenBits;

    [[nodiscard]] std::int64_t reached() const noexcept {
      const std::int64_t below = kernel_->cumulative(at_);
      if (between_ == 0) return below;
      return below + (((kernel_->cumulative(at_ + 1) - below) * between_) >> kBetweenBits);
    }

    const RayleighKernel* kernel_;
    std::int64_t at_;       ///< whole rings of the table ..
    std::int64_t between_;  ///< .. and a fraction, in 2^-20
    WideQuanta amount_;
    WideQuanta dealt_ = 0;
  };

  /// P_d(j), for reports and tests.
  [[nodiscard]] double weight(std::size_t j) const noexcept;

 private:
  // 40 bits of fraction: 2^24 rings of 2^61 quanta times 2^40 still fit 127 bits.
  static constexpr int kFractionBits = 40;
  static WideQuanta part(WideQuanta amount, std::int64_t fraction) noexcept {
    // One multiplication instead of three for what an ordinary tick moves.
    if (const auto narrow = static_cast<std::int64_t>(amount); narrow == amount)
      return (WideQuanta{narrow} * fraction) >> kFractionBits;
    return (amount * fraction) >> kFractionBits;
  }
  [[nodiscard]] std::int64_t cumulative(std::int64_t j) const noexcept {
    const auto last = static_cast<std::int64_t>(length());
    return cumulative_[static_cast<std::size_t>(std::clamp<std::int64_t>(j, 0, last))];
  }
  std::vector<std::int64_t> cumulative_;  ///< C_0 = 0 .. C_L1 = 2^40
};

}  // namespace clay
