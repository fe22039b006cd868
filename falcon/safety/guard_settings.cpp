#include "claystack/falcon/guard.hpp"

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
  for (const OutOfRange& range : ranges)
    if (!(range.low <= range.found && range.found <= range.high)) return tl::make_unexpected(range);
  return {};
}

}  // namespace clay::falcon::inline safety
