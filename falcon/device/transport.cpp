#include "claystack/falcon/device.hpp"

#include <time.h>

namespace clay::falcon::inline device {

std::int64_t monotonic_us() noexcept {
  timespec now{};
  clock_gettime(CLOCK_MONOTONIC, &now);
  return std::int64_t{now.tv_sec} * 1'000'000 + now.tv_nsec / 1'000;
}

std::int64_t Transport::now_us() const noexcept { return monotonic_us(); }

}  // namespace clay::falcon::inline device
