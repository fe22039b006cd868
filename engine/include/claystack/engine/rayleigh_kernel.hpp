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

  /// Deals an amount out to the rings 1..L1 in their order, to the quantum: what all of them get
  /// adds up to it.
  class Dealer {
   public:
    Dealer(const RayleighKernel& kernel, WideQuanta amount) noexcept
        : next_(kernel.cumulative_.data() + 1), amount_(amount) {}
    /// The share of the next ring. Call it at most L1 times.
    WideQuanta next() noexcept {
      const WideQuanta before = dealt_;
      dealt_ = part(amount_, *next_++);
      return dealt_ - before;
    }

   private:
    const std::int64_t* next_;
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
  std::vector<std::int64_t> cumulative_;  ///< C_0 = 0 .. C_L1 = 2^40
};

}  // namespace clay
