#pragma once
#include "claystack/engine/clay.hpp"

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
  /// reach = 0 gives no ring a share, so that everything goes into height.
  RayleighKernel(double sigma_mm, double reach_mm, double ring_height_mm, std::size_t max_rings);

  [[nodiscard]] std::size_t length() const noexcept { return cumulative_.size() - 1; }  ///< L1
  /// The rings that get clay. If sigma is much less than the reach, the other rings of L1 have
  /// weights that round to the integer 0.
  [[nodiscard]] std::size_t effective_length() const noexcept { return effective_length_; }

  /// The cumulative distribution up to ring 1, 2, ... `offset` (in ring heights, at least -1) moves
  /// all rings away from the tool: ring j then reaches from j - 1 + offset to j + offset in a
  /// distribution that is even within each ring of the table. Ring 1 also gets the part before it.
  /// A negative offset leaves a part for ring L1 + 1.
  class ShareCursor {
   public:
    explicit ShareCursor(const RayleighKernel& kernel, double offset = 0.0) noexcept
        : kernel_(&kernel),
          at_(static_cast<std::int64_t>(std::floor(offset)) + 1),
          between_(static_cast<std::int64_t>((offset - std::floor(offset)) * kBetweenOne)),
          below_(kernel.cumulative(at_)) {}
    /// The part of the whole that the rings get, up to and including the next one, in 2^-40.
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

  /// Divides an amount by the parts that a ShareCursor returns; the shares of rings 1..L1 add up to
  /// the amount, to the quantum. Quanta and WideQuanta give the same shares: the amounts of an
  /// ordinary tick fit into 64 bits, which takes one multiplication instead of three.
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
