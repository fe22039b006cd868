#pragma once
#include <array>
#include <cstddef>
#include <glm/vec3.hpp>

namespace clay::falcon::inline safety {

inline constexpr int kMostSwings = 16;

/// Counts reversals of a force in any direction.
class SwingCounter {
 public:
  /// `limit`: 2 to kMostSwings; a swing below `least_n` does not count.
  SwingCounter(int limit, double window_s, double least_n) noexcept;
  /// The force at an increasing time [s]. True if `limit` swings ended within the window.
  bool swings_too_often(double time_s, const glm::dvec3& force_n) noexcept;

 private:
  std::size_t limit_, count_ = 0;
  double window_s_, least_n_;
  glm::dvec3 extreme_{0.0}, direction_{0.0};
  std::array<double, kMostSwings> times_s_{};  // of the last swings, a ring
};

}  // namespace clay::falcon::inline safety
