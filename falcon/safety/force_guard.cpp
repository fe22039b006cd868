#include "falcon/device/setting_ranges.hpp"
#include "falcon/safety/basic_guard.hpp"

#include <utility>

namespace clay::falcon::inline safety {

tl::expected<void, OutOfRange> check(const GuardSettings& s) noexcept {
  constexpr double kTiny = 1e-3;  // of a force [N] or the length of a fade [s]
  const double held_s = kHeldPeriods * s.period_s;
  const OutOfRange ranges[] = {
      {"period_s", 0.0001, 0.0025, s.period_s},
      {"force_limit_n", kTiny, kMostForceN, s.force_limit_n},
      {"slew_n_per_s", 1.0, 5000.0, s.slew_n_per_s},
      {"small_force_n", kTiny / 10.0, s.force_limit_n, s.small_force_n},
      {"small_force_ticks", 1, 1000, static_cast<double>(s.small_force_ticks)},
      {"ramp_s", 0.1, 60.0, s.ramp_s},
      {"stale_fade_s", 2.0 * s.period_s, kLongestToZeroS - kTiny - held_s, s.stale_fade_s},
      {"stale_zero_s", s.stale_fade_s + kTiny + held_s, kLongestToZeroS, s.stale_zero_s},
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

struct ForceGuard::State {
  BasicForceGuard<kAllGuardRules> guard;
};

tl::expected<ForceGuard, OutOfRange> ForceGuard::build(const GuardSettings& settings) {
  return check(settings).map([&] {
    return ForceGuard(std::make_unique<State>(State{BasicForceGuard<kAllGuardRules>(settings)}));
  });
}

ForceGuard::ForceGuard(std::unique_ptr<State> state) noexcept : state_(std::move(state)) {}
ForceGuard::ForceGuard(ForceGuard&&) noexcept = default;
ForceGuard& ForceGuard::operator=(ForceGuard&&) noexcept = default;
ForceGuard::~ForceGuard() = default;

Admission ForceGuard::admit(std::int64_t now_us, const GuardSample& sample) noexcept {
  return state_->guard.admit(now_us, sample);
}

GuardedForce ForceGuard::force(std::int64_t now_us, const WantedForce& wanted) noexcept {
  return state_->guard.force(now_us, wanted);
}

void ForceGuard::pause() noexcept { state_->guard.pause(); }
void ForceGuard::stop() noexcept { state_->guard.stop(); }
void ForceGuard::was_zeroed() noexcept { state_->guard.was_zeroed(); }
bool ForceGuard::rearm() noexcept { return state_->guard.rearm(); }

}  // namespace clay::falcon::inline safety
