#include "claystack/falcon/guard.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace clay::falcon {
namespace {

struct InvalidSetting {
  const char* setting;
  double GuardSettings::*number;
  double low, high;  ///< just outside
};

TEST(GuardSettings, ErrorsNameTheInvalidSetting) {
  const GuardSettings sound;
  ASSERT_TRUE(check(sound));
  const InvalidSetting cases[] = {
      {"period_s", &GuardSettings::period_s, 0.00009, 0.0026},
      {"force_limit_n", &GuardSettings::force_limit_n, 0.0, 8.1},
      {"slew_n_per_s", &GuardSettings::slew_n_per_s, 0.9, 5001.0},
      {"small_force_n", &GuardSettings::small_force_n, 0.0, 5.1},
      {"ramp_s", &GuardSettings::ramp_s, 0.09, 61.0},
      {"stale_fade_s", &GuardSettings::stale_fade_s, 0.0019, 0.0076},
      {"stale_zero_s", &GuardSettings::stale_zero_s, 0.0074, 0.0101},
      {"late_zero_s", &GuardSettings::late_zero_s, 0.0019, 0.0101},
      {"pause_s", &GuardSettings::pause_s, 0.0099, 1.1},
      {"jump_mm_per_s", &GuardSettings::jump_mm_per_s, 99.0, 10'001.0},
      {"clay_fade_s", &GuardSettings::clay_fade_s, 0.0019, 1.1},
      {"clay_zero_s", &GuardSettings::clay_zero_s, 0.1009, 2.1},
      {"hot_force_n", &GuardSettings::hot_force_n, 0.0, 5.1},
      {"hot_time_s", &GuardSettings::hot_time_s, 0.09, 61.0},
      {"hot_fade_s", &GuardSettings::hot_fade_s, 0.04, 11.0},
      {"safe_rest_s", &GuardSettings::safe_rest_s, 0.009, 11.0},
  };
  for (const InvalidSetting& invalid : cases)
    for (const double value :
         {invalid.low, invalid.high, std::nan(""), std::numeric_limits<double>::infinity()}) {
      GuardSettings settings;
      settings.*invalid.number = value;
      const auto guard = ForceGuard::build(settings);
      ASSERT_FALSE(guard) << invalid.setting << " = " << value;
      // A NaN limit also bounds other settings; the error must name the NaN.
      EXPECT_STREQ(guard.error().setting, invalid.setting) << value;
      EXPECT_TRUE(guard.error().found == value || std::isnan(value));
      EXPECT_FALSE(value >= guard.error().low && value <= guard.error().high);
      // The bounds are near the values just outside.
      EXPECT_LE(guard.error().low, 1.3 * invalid.low + 0.0011) << invalid.setting;
      EXPECT_GE(guard.error().high, invalid.high / 1.3) << invalid.setting;
    }
  EXPECT_TRUE(check({.period_s = 0.0025}));
  EXPECT_FALSE(check({.period_s = 0.0025, .stale_fade_s = 0.0053})) << "no time for the last tick";
  EXPECT_FALSE(check({.period_s = 0.0025, .stale_zero_s = 0.0097}));
  for (const int ticks : {0, -1, 1001}) EXPECT_FALSE(check({.small_force_ticks = ticks}));
  for (const int ticks : {0, -1, 11}) EXPECT_FALSE(check({.not_finite_ticks = ticks}));
}

}  // namespace
}  // namespace clay::falcon
