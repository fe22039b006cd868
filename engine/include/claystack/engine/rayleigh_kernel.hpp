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
  /// The rings that get something. The rest of L1, where sigma is much less than the reach, has
  /// weights that are 0 as integers.
  [[nodiscard]] std::size_t effective_length() const noexcept { return effective_length_; }

  /// The distribution as far as ring 1, 2, .. in their order. `offset` (in ring heights, at least
  /// -1) moves all rings away from the tool: ring j then reaches from j - 1 + offset to j + offset
  /// in a distribution that is even within each ring of the table, and ring 1 has what lies before
  /// it too. A negative offset leaves something to ring L1 + 1.
  class Dealer {
   public:
    explicit Dealer(const RayleighKernel& kernel, double offset = 0.0) noexcept
        : kernel_(&kernel),
          at_(static_cast<std::int64_t>(std::floor(offset)) + 1),
          between_(static_cast<std::int64_t>((offset - std::floor(offset)) * kBetweenOne)),
          below_(kernel.cumulative(at_)) {}
    /// The part of the whole that the rings get up to and with the next one, in 2^-40.
    std::int64_t next() noexcept {
      const std::int64_t below = below_;
      below_ = kernel_->cumulative(++at_);
      return below + (((below_ - below) * between_) >> kBetweenBits);
    }

   private:
    static constexpr int kBetweenBits = 20;
    static constexpr double kBetweenOne = 1 << kBetweenBits;

    const RayleighKernel* kernel_;
    std::int64_t at_;       ///< whole rings of the table ..
    std::int64_t between_;  ///< .. and a fraction, in 2^-20
    std::int64_t below_;    ///< C at at_
  };

  /// Deals an amount out by the parts that a Dealer names, to the quantum: what rings 1..L1 get
  /// adds up to it. Quanta or WideQuanta, which give the same shares: what an ordinary tick moves
  /// fits into 64 bits, which is one multiplication instead of three.
  template <class Amount>
  class Shares {
   public:
    explicit Shares(Amount amount) noexcept : amount_(amount) {}
    /// The share of the next ring.
    Amount next(std::int64_t part) noexcept {
      const Amount before = dealt_;
      dealt_ = static_cast<Amount>((WideQuanta{amount_} * part) >> kFractionBits);
      return dealt_ - before;
    }

   private:
    Amount amount_, dealt_ = 0;
  };

  /// P_d(j), for reports and tests.
  [[nodiscard]] double weight(std::size_t j) const noexcept;

 private:
  // 40 bits of fraction: 2^24 rings of 2^61 quanta times 2^40 still fit 127 bits.
  static constexpr int kFractionBits = 40;
  [[nodiscard]] std::int64_t cumulative(std::int64_t j) const noexcept {
    const auto last = static_cast<std::int64_t>(length());
    return cumulative_[static_cast<std::size_t>(std::min(j, last))];
  }
  std::vector<std::int64_t> cumulative_;  ///< C_0 = 0 .. C_L1 = 2^40
  std::size_t effective_length_ = 0;
};

}  // namespace clay
