#include "app/servo/live_clay.hpp"

#include <algorithm>

namespace clay::servo {

StepReport LiveClay::meet(const Pose& measured) noexcept {
  const Pose pose = quantized(measured);
  if (pose.time_us <= last_us_) return {.flags = kRefused};
  if (pose.time_us < due_us_) return wheel_.feel(pose);
  const StepReport report = wheel_.step(pose);
  if ((report.flags & kRefused) != 0) return report;
  last_us_ = pose.time_us;
  // Periods that were missed are not made up for.
  due_us_ = std::max(due_us_ + period_us_, pose.time_us + period_us_ / 2);
  ++poses_;
  if (recorder_ != nullptr) (void)recorder_->take(pose);
  return report;
}

}  // namespace clay::servo
