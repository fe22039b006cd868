#include "falcon/safety/guard_rules.hpp"

#include "core/limit_norm.hpp"

#include <algorithm>
#include <glm/geometric.hpp>

namespace clay::falcon::inline safety {

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

double Recovery::after(double held, double growing_s) noexcept {
  constexpr double kRecoveryS = 0.5;  // from 0 to 1; our judgement
  part_ = std::min(held, part_ + growing_s / kRecoveryS);
  return part_;
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

}  // namespace clay::falcon::inline safety
