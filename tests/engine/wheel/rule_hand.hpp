#pragma once
// A hand that moves along straight lines at 1 kHz, and measurements of the pot after it.

#include "claystack/engine/wheel.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>

namespace clay {

class Hand {
 public:
  explicit Hand(Wheel& wheel) : wheel_(wheel) {}
  void move_to(double x, double y, double mm_s, double gap_mm = 0.0) {
    const double distance = std::hypot(x - x_, y - y_);
    const int ticks = std::max(1, static_cast<int>(distance / mm_s * 1000.0));
    const double from_x = x_, from_y = y_;
    for (int k = 1; k <= ticks; ++k) {
      x_ = from_x + (x - from_x) * k / ticks;
      y_ = from_y + (y - from_y) * k / ticks;
      wheel_.step({time_us_ += 1000, {x_, y_, 0.0}, false, gap_mm});
    }
  }
  void place_at(double x, double y, double gap_mm = 0.0) {
    x_ = x;
    y_ = y;
    wheel_.step({time_us_ += 1000, {x, y, 0.0}, false, gap_mm});
  }

 private:
  Wheel& wheel_;
  double x_ = 0.0, y_ = 0.0;
  std::int64_t time_us_ = 0;
};

inline const Ring& ring_at(const Wheel& wheel, double y) {
  return wheel.stack().rings()[static_cast<std::size_t>(y / wheel.stack().ring_height_mm())];
}
inline double middle_of(const Ring& ring) { return 0.5 * (ring.outer_mm() + ring.inner_mm()); }

/// Two tools lift the wall of cylinder_scene() from 25 to 85 mm. The rise of the pot for each mm
/// that they go up, from 45 mm on.
inline double rise_of_pinch(Wheel& wheel, double mm_s, double gap_mm) {
  constexpr double kMiddleMm = 42.5, kFromMm = 45.0, kToMm = 85.0;
  Hand hand(wheel);
  hand.place_at(kMiddleMm, 25.0);
  hand.move_to(kMiddleMm, kFromMm, mm_s, gap_mm);
  const double start_mm = wheel.stack().height_mm();
  hand.move_to(kMiddleMm, kToMm, mm_s, gap_mm);
  return (wheel.stack().height_mm() - start_mm) / (kToMm - kFromMm);
}

}  // namespace clay
