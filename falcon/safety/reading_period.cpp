#include "falcon/safety/reading_period.hpp"

#include <algorithm>

namespace clay::falcon::inline safety {
namespace {

constexpr double kReadings = 64.0;  // of the mean
constexpr double kApart = 1.15, kTogether = 1.03;
// A longer interval is a pause, after which the force starts from zero.
constexpr double kLongestS = 0.05;

}  // namespace

ReadingPeriod::ReadingPeriod(double stated_s) noexcept
    : stated_s_(stated_s), mean_s_(stated_s), in_use_s_(stated_s) {}

bool ReadingPeriod::follow(double interval_s) noexcept {
  const double longest_s = std::max(kLongestS, stated_s_);
  mean_s_ += (std::min(interval_s, longest_s) - mean_s_) / kReadings;
  const bool as_stated = mean_s_ <= kTogether * stated_s_;
  const bool apart = mean_s_ > kApart * in_use_s_ || kApart * mean_s_ < in_use_s_;
  if (as_stated ? !is_slow() : !apart) return false;
  in_use_s_ = as_stated ? stated_s_ : mean_s_;
  return true;
}

}  // namespace clay::falcon::inline safety
