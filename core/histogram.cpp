#include "core/histogram.hpp"

#include <algorithm>
#include <bit>
#include <cmath>

namespace clay {
namespace {

constexpr unsigned kBits = Histogram::kBits;

std::size_t bucket_of(std::int64_t ns) noexcept {
  const auto value = static_cast<std::uint64_t>(std::max<std::int64_t>(ns, 0));
  const auto width = static_cast<unsigned>(std::bit_width(value));
  if (width <= kBits) return value;
  const unsigned octave = width - kBits;  // 1 for 32 to 63: the leading bit is implicit
  const std::uint64_t mantissa = (value >> (octave - 1)) - (1u << kBits);
  return (std::size_t{octave} << kBits) + mantissa;
}

/// The largest time of a bucket.
std::int64_t longest_of(std::size_t bucket) noexcept {
  const std::uint64_t octave = bucket >> kBits, mantissa = bucket & ((1u << kBits) - 1);
  if (octave == 0) return static_cast<std::int64_t>(mantissa);
  const std::uint64_t next = ((std::uint64_t{1} << kBits) + mantissa + 1) << (octave - 1);
  return static_cast<std::int64_t>(next - 1);
}

}  // namespace

void Histogram::add(std::int64_t ns) noexcept {
  const std::int64_t time = std::max<std::int64_t>(ns, 0);
  ++counts_[bucket_of(time)];
  ++count_;
  most_ = std::max(most_, time);
  sum_ += static_cast<double>(time);
}

double Histogram::mean_ns() const noexcept {
  return count_ > 0 ? sum_ / static_cast<double>(count_) : 0.0;
}

std::int64_t Histogram::quantile_ns(double part) const noexcept {
  const double kept = part > 0.0 ? std::min(part, 1.0) : 0.0;
  const double place = std::ceil(kept * static_cast<double>(count_));
  std::uint64_t left = std::max<std::uint64_t>(1, static_cast<std::uint64_t>(place));
  for (std::size_t bucket = 0; bucket < kBuckets; ++bucket) {
    if (counts_[bucket] >= left) return std::min(longest_of(bucket), most_);
    left -= counts_[bucket];
  }
  return most_;
}

}  // namespace clay
