#pragma once
// Times of many ticks in little memory: exact below 32 ns, then 32 buckets per doubling, as in a
// floating-point number with 5 bits of mantissa. Never allocates; adding takes a few instructions.

#include <array>
#include <cstddef>
#include <cstdint>

namespace clay {

class Histogram {
 public:
  static constexpr unsigned kBits = 5;
  /// A quantile exceeds the true time by at most this fraction, and is never below it.
  static constexpr double kRelativeError = 1.0 / (1u << kBits);

  /// Adds a time [ns]; negative times (early, not late) count as 0.
  void add(std::int64_t ns) noexcept;
  void clear() noexcept { *this = {}; }

  [[nodiscard]] std::uint64_t count() const noexcept { return count_; }
  [[nodiscard]] std::int64_t most_ns() const noexcept { return most_; }
  /// Exact up to rounding; 0 when empty.
  [[nodiscard]] double mean_ns() const noexcept;

  /// The smallest time that at least the fraction `part` (0 to 1) of all times do not exceed: the
  /// element at index max(1, ceil(part n)) of the n sorted times, or up to kRelativeError above it,
  /// and at most most_ns. 0 when empty.
  [[nodiscard]] std::int64_t quantile_ns(double part) const noexcept;

 private:
  // Octave 0 holds 0 to 31 ns; an int64 has 63 - kBits more.
  static constexpr std::size_t kBuckets = std::size_t{64 - kBits} << kBits;

  std::array<std::uint64_t, kBuckets> counts_{};
  std::uint64_t count_ = 0;
  std::int64_t most_ = 0;
  double sum_ = 0.0;
};

}  // namespace clay
