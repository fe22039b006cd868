#pragma once
// Times of many ticks in little memory: exact below 32 ns, then 32 buckets to each doubling, as
// in a floating point number of 5 bits. Never allocates, and adds in a few instructions.

#include <array>
#include <cstddef>
#include <cstdint>

namespace clay {

class Histogram {
 public:
  static constexpr unsigned kBits = 5;
  /// A quantile is at most this part above the time it stands for, and never below.
  static constexpr double kRelativeError = 1.0 / (1u << kBits);

  /// A time [ns]; negative ones count as 0 (and are early, not late).
  void add(std::int64_t ns) noexcept;
  /// Adds all that `other` has counted.
  void merge(const Histogram& other) noexcept;
  void clear() noexcept { *this = {}; }

  [[nodiscard]] std::uint64_t count() const noexcept { return count_; }
  [[nodiscard]] std::int64_t least_ns() const noexcept { return count_ > 0 ? least_ : 0; }
  [[nodiscard]] std::int64_t most_ns() const noexcept { return most_; }
  /// To rounding; 0 of nothing.
  [[nodiscard]] double mean_ns() const noexcept;

  /// The least time that `part` of all times don't exceed: of n times sorted, the one at place
  /// max(1, ceil(part n)), or above it by kRelativeError at most; never beyond most_ns. `part` from
  /// 0 to 1; 0 of nothing.
  [[nodiscard]] std::int64_t quantile_ns(double part) const noexcept;

  /// How many times were as long as `ns` or longer, to the bucket: times that share a bucket with
  /// `ns` count.
  [[nodiscard]] std::uint64_t count_from(std::int64_t ns) const noexcept;

 private:
  // Octave 0 holds 0 to 31 ns; an int64 has 63 - kBits more.
  static constexpr std::size_t kBuckets = std::size_t{64 - kBits} << kBits;

  std::array<std::uint64_t, kBuckets> counts_{};
  std::uint64_t count_ = 0;
  std::int64_t least_ = INT64_MAX, most_ = 0;
  double sum_ = 0.0;
};

}  // namespace clay
