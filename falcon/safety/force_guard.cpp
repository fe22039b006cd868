#include "falcon/safety/force_guard.hpp"
#include "falcon/device/setting_ranges.hpp"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <limits>

namespace clay::falcon::inline safety {

tl::expected<void, OutOfRange> check(const GuardSettings& s) noexcept {
  constexpr double kTiny = 1e-3;  // of a force [N] or the length of a fade [s]
  const OutOfRange ranges[] = {
      {"period_s", 0.0001, 0.0025, s.period_s},
      {"force_limit_n", kTiny, kMostForceN, s.force_limit_n},
      {"slew_n_per_s", 1.0, 5000.0, s.slew_n_per_s},
      {"small_force_n", kTiny / 10.0, s.force_limit_n, s.small_force_n},
      {"small_force_ticks", 1, 1000, static_cast<double>(s.small_force_ticks)},
      {"ramp_s", 0.1, 60.0, s.ramp_s},
      {"stale_fade_s", 2.0 * s.period_s, kLongestToZeroS - kTiny, s.stale_fade_s},
      {"stale_zero_s", s.stale_fade_s + kTiny, kLongestToZeroS, s.stale_zero_s},
      {"late_zero_s", 2.0 * s.period_s, kLongestToZeroS, s.late_zero_s},
      {"pause_s", s.late_zero_s, 1.0, s.pause_s},
      {"jump_mm_per_s", 100.0, 10'000.0, s.jump_mm_per_s},
      {"clay_fade_s", 2.0 * s.period_s, 1.0, s.clay_fade_s},
      {"clay_zero_s", s.clay_fade_s + kTiny, 2.0, s.clay_zero_s},
      {"hot_force_n", kTiny, s.force_limit_n, s.hot_force_n},
      {"hot_time_s", 0.1, 60.0, s.hot_time_s},
      {"hot_fade_s", 0.05, 10.0, s.hot_fade_s},
      {"not_finite_ticks", 1, 10, static_cast<double>(s.not_finite_ticks)},
      {"safe_rest_s", 0.01, 10.0, s.safe_rest_s},
  };
  return check_ranges(ranges);
}

double elapsed_s(std::int64_t from_us, std::int64_t to_us) noexcept {
  constexpr std::uint64_t kMost = 1'000'000'000;
  if (to_us <= from_us) return 0.0;
  const auto elapsed = static_cast<std::uint64_t>(to_us) - static_cast<std::uint64_t>(from_us);
  return static_cast<double>(std::min(elapsed, kMost)) / 1e6;
}

glm::dvec3 limit_rise(const glm::dvec3& wanted, const glm::dvec3& before, double rise) noexcept {
  const double size = glm::dot(before, before);
  const double kept = size > 0.0 ? std::clamp(glm::dot(wanted, before) / size, 0.0, 1.0) : 0.0;
  const glm::dvec3 way = wanted - kept * before;
  const double length = norm(way);
  return length <= rise ? wanted : kept * before + way * (rise / length);
}

double fade(double age, double from, double zero) noexcept {
  return std::clamp((zero - age) / (zero - from), 0.0, 1.0);
}

TickTime TickClock::advance(std::int64_t now_us, double period_s) noexcept {
  TickTime time;
  if (started_) time.real_s = elapsed_s(last_us_, now_us);
  time.growing_s = std::min(time.real_s, period_s);
  time.fading_s = std::max(time.real_s, kShortestStepS);
  last_us_ = now_us;
  started_ = true;
  return time;
}

void Age::see(std::int64_t stamp_us, std::int64_t now_us) noexcept {
  if (is_last(stamp_us)) return;
  stamp_us_ = stamp_us;
  passed_s_ = elapsed_s(stamp_us, now_us);
  any_ = true;
}

double Age::at(std::int64_t now_us) const noexcept {
  return std::max(passed_s_, elapsed_s(stamp_us_, now_us));
}

bool Age::is_last(std::int64_t stamp_us) const noexcept { return any_ && stamp_us == stamp_us_; }

JumpFilter::Verdict JumpFilter::take(const glm::dvec3& position_mm, double reach_mm) noexcept {
  const double moved = norm(position_mm - plausible_mm_);
  const bool reached = !any_ || moved <= reach_mm;
  const bool by_suspect = suspected_ && norm(position_mm - suspect_mm_) < moved;
  if (reached && !by_suspect) {
    plausible_mm_ = position_mm;
    any_ = true;
    suspected_ = false;
    return Verdict::plausible;
  }
  if (suspected_) {
    forget();
    return Verdict::stays;
  }
  suspect_mm_ = position_mm;
  suspected_ = true;
  return Verdict::dropped;
}

void Engagement::want(double wanted_n, double small_n, int ticks) noexcept {
  if (phase_ != Phase::waiting) return;
  small_ticks_ = wanted_n < small_n ? small_ticks_ + 1 : 0;
  if (small_ticks_ >= ticks) phase_ = Phase::ramping;
}

void Engagement::grow(double growing_s, double ramp_s) noexcept {
  if (phase_ != Phase::ramping) return;
  gain_ = std::min(1.0, gain_ + growing_s / ramp_s);
  if (gain_ == 1.0) phase_ = Phase::engaged;
}

void HeatLimit::hold(double force_n, double hot_n, const TickTime& time, double most_s) noexcept {
  hot_s_ += force_n > hot_n ? time.fading_s : -time.growing_s;
  hot_s_ = std::clamp(hot_s_, 0.0, most_s);
  fading_ = fading_ || hot_s_ == most_s;
}

bool HeatLimit::fade_out(double fading_s, double fade_s) noexcept {
  if (!fading_) return false;
  gain_ -= fading_s / fade_s;
  if (gain_ > 0.0) return false;
  gain_ = 1.0;
  fading_ = false;
  return true;
}

template class BasicForceGuard<kAllGuardRules>;

}  // namespace clay::falcon::inline safety
