#include "app/servo/clock.hpp"

#include <time.h>

#include <algorithm>
#include <cerrno>

namespace clay::servo {
namespace {

constexpr std::int64_t kNsPerS = 1'000'000'000;
constexpr std::int64_t kMarginNs = 5'000;
constexpr std::int64_t kSleepsRemembered = 512;

}  // namespace

std::int64_t MonotonicClock::now_ns() noexcept {
  timespec now{};
  clock_gettime(CLOCK_MONOTONIC, &now);
  return now.tv_sec * kNsPerS + now.tv_nsec;
}

void MonotonicClock::sleep_until_ns(std::int64_t time_ns) noexcept {
  if (time_ns <= now_ns()) return;
  const timespec until{time_ns / kNsPerS, static_cast<long>(time_ns % kNsPerS)};
  while (clock_nanosleep(CLOCK_MONOTONIC, TIMER_ABSTIME, &until, nullptr) == EINTR) {
  }
}

std::int64_t MonotonicClock::wake_at_ns(std::int64_t time_ns) noexcept {
  const std::int64_t wake_ns = time_ns - lead_ns_;
  std::int64_t late_ns = 0;
  if (now_ns() < wake_ns) {
    sleep_until_ns(wake_ns);
    late_ns = now_ns() - wake_ns;
    const std::int64_t faded_ns = lead_ns_ - lead_ns_ / kSleepsRemembered;
    lead_ns_ = std::min(std::max(late_ns + kMarginNs, faded_ns), kLongestLookNs);
  }
  while (now_ns() < time_ns) {
  }
  return late_ns;
}

}  // namespace clay::servo
