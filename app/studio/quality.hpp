#pragma once
// How finely the view is drawn: a machine without a graphics card shows a pot that moves in fewer
// pixels, and sharp again when it stands still.

#include <algorithm>
#include <array>
#include <cstddef>

namespace clay::studio {

struct Fineness {
  int samples;  ///< of each pixel
  int divisor;  ///< of the view's width and height
};
inline constexpr std::array<Fineness, 4> kFineness = {{{4, 1}, {1, 1}, {1, 2}, {1, 3}}};

class Quality {
 public:
  /// Of the next frame.
  [[nodiscard]] Fineness fineness(bool moving) const noexcept {
    return kFineness[moving ? level_ : 0];
  }
  /// A frame of the pot in motion took so long, drawing and all.
  void took(double seconds) noexcept {
    smooth_s_ = smooth_s_ > 0.0 ? 0.7 * smooth_s_ + 0.3 * seconds : seconds;
    // A pot that lags behind the hand is worse than a coarse one: down at once, up with patience.
    if (smooth_s_ > kSlowS && level_ + 1 < kFineness.size())
      change(level_ + 1);
    else if (++since_ >= kFramesBetween && smooth_s_ < kFastS && level_ > 0)
      change(level_ - 1);
  }

 private:
  // The next finer level costs up to four times as much.
  static constexpr double kSlowS = 0.033, kFastS = 0.006;
  static constexpr int kFramesBetween = 30;
  void change(std::size_t level) noexcept {
    level_ = level;
    since_ = 0;
    smooth_s_ = 0.0;
  }

  std::size_t level_ = 0;
  double smooth_s_ = 0.0;
  int since_ = 0;
};

}  // namespace clay::studio
