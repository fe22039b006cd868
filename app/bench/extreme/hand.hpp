#pragma once
#include "claystack/engine/tool.hpp"

#include <algorithm>
#include <cstdint>
#include <random>

namespace clay::extreme {

/// A hand that moves over and into the small pot, inside and outside, past rim and base, with
/// occasional jumps. It gives the same poses on every platform: it uses the random
/// engine of the standard, but none of its distributions.
class Hand {
 public:
  explicit Hand(std::uint64_t seed) : random_(seed) {}

  double uniform() { return static_cast<double>(random_() >> 11) * 0x1p-53; }  ///< [0, 1)

  Pose next() {
    if (uniform() < 0.002) choose();
    const double speed = uniform() < 0.01 ? 5.0 : 0.1;
    const bool level = uniform() < 0.5;  // a slow hand, whose height often does not change
    for (int axis = 0; axis < 3; ++axis) {
      if (axis == 1 && level) continue;
      at_[axis] += std::clamp(goal_[axis] - at_[axis], -speed, speed) + 0.02 * (uniform() - 0.5);
    }
    time_us_ += 1000;
    return {time_us_, at_, false};
  }

 private:
  void choose() {
    const double u = uniform();
    goal_.y = u < 0.2 ? 0.0 : u < 0.4 ? 66.0 : 60.0 * uniform();
    goal_.x = uniform() < 0.2 ? 0.0 : 45.0 * uniform();
    goal_.z = uniform() < 0.7 ? 0.0 : 10.0 * uniform();
  }

  std::mt19937_64 random_;
  glm::dvec3 at_{40.0, 20.0, 0.0}, goal_{28.0, 20.0, 0.0};
  std::int64_t time_us_ = 0;
};

}  // namespace clay::extreme
