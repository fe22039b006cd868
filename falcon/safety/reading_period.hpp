#pragma once

namespace clay::falcon::inline safety {

/// The period that the bounds of a sampled loop must assume: the stated one, or a longer one at
/// which the readings of a slow device come. It follows the mean interval in steps of 15 %, so that
/// single late readings change nothing; the margin of accepted_stiffness covers smaller
/// differences.
class ReadingPeriod {
 public:
  explicit ReadingPeriod(double stated_s) noexcept;

  /// A reading `interval_s` after the last one. True if the period has changed.
  bool follow(double interval_s) noexcept;

  [[nodiscard]] double in_use_s() const noexcept { return in_use_s_; }
  [[nodiscard]] bool is_slow() const noexcept { return in_use_s_ > stated_s_; }

 private:
  double stated_s_, mean_s_, in_use_s_;
};

}  // namespace clay::falcon::inline safety
