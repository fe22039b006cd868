#include "falcon/safety/swing_counter.hpp"

#include <cassert>
#include <glm/geometric.hpp>

namespace clay::falcon::inline safety {

SwingCounter::SwingCounter(int limit, double window_s, double least_n) noexcept
    : limit_(static_cast<std::size_t>(limit)), window_s_(window_s), least_n_(least_n) {
  assert(limit >= 2 && limit <= kMostSwings);
}

bool SwingCounter::swings_too_often(double time_s, const glm::dvec3& force_n) noexcept {
  const glm::dvec3 since = force_n - extreme_;
  const double along = glm::dot(since, direction_);
  if (along > 0.0) {
    extreme_ = force_n;
    return false;
  }
  const double size = glm::length(since);
  if (!(size > least_n_) || (direction_ != glm::dvec3(0.0) && !(-along > least_n_))) return false;
  extreme_ = force_n;
  direction_ = since / size;
  times_s_[count_ % limit_] = time_s;
  ++count_;
  const double first = times_s_[count_ % limit_];  // of the last `limit` swings
  return count_ >= limit_ && time_s - first <= window_s_;
}

}  // namespace clay::falcon::inline safety
