#pragma once
#include "app/servo/clock.hpp"

#include <cstdint>

namespace clay::studio {

/// Sleeping advances the time to the end of the sleep.
class VirtualClock final : public servo::Clock {
 public:
  [[nodiscard]] std::int64_t now_ns() noexcept override { return now_ns_; }
  void sleep_until_ns(std::int64_t time_ns) noexcept override {
    if (time_ns > now_ns_) now_ns_ = time_ns;
  }

 private:
  std::int64_t now_ns_ = 1'000'000'000;  // times of a device must be above 0
};

}  // namespace clay::studio
