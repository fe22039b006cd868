#include "live/clock.hpp"

#include <time.h>

#include <cerrno>

namespace clay::live {
namespace {

constexpr std::int64_t kNsPerS = 1'000'000'000;

}  // namespace

std::int64_t MonotonicClock::now_ns() noexcept {
  timespec now{};
  clock_gettime(CLOCK_MONOTONIC, &now);
  return now.tv_sec * kNsPerS + now.tv_nsec;
}

void MonotonicClock::sleep_until_ns(std::int64_t time_ns) noexcept {
  if (time_ns <= now_ns()) return;
  const timespec until{time_ns / kNsPerS, time_ns % kNsPerS};
  while (clock_nanosleep(CLOCK_MONOTONIC, TIMER_ABSTIME, &until, nullptr) == EINTR) {
  }
}

}  // namespace clay::live
