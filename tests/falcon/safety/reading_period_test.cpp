#include "falcon/safety/reading_period.hpp"

#include <gtest/gtest.h>

#include <limits>

namespace clay::falcon {
namespace {

constexpr double kStatedS = 1e-3;

int changes(ReadingPeriod& period, double interval_s, int readings) {
  int changed = 0;
  for (int k = 0; k < readings; ++k) changed += period.follow(interval_s) ? 1 : 0;
  return changed;
}

TEST(ReadingPeriod, FollowsASlowDeviceAndItsRecovery) {
  for (const double slow_s : {1.2e-3, 2e-3, 4e-3, 10e-3}) {
    ReadingPeriod period(kStatedS);
    EXPECT_GE(changes(period, slow_s, 1000), 1);
    EXPECT_TRUE(period.is_slow());
    EXPECT_GE(1.15 * period.in_use_s(), 0.999 * slow_s);
    EXPECT_LE(period.in_use_s(), slow_s);
    EXPECT_EQ(changes(period, slow_s, 1000), 0) << "steady";
    EXPECT_GE(changes(period, kStatedS, 1000), 1);
    EXPECT_FALSE(period.is_slow());
    EXPECT_EQ(period.in_use_s(), kStatedS);
  }
}

TEST(ReadingPeriod, IgnoresAFasterDeviceAndSingleLateReadings) {
  ReadingPeriod period(kStatedS);
  EXPECT_EQ(changes(period, 0.1e-3, 1000), 0);
  EXPECT_EQ(changes(period, kStatedS, 1000), 0);
  // One frame in a hundred is lost, and a tick is 9 ms late.
  for (int k = 0; k < 10; ++k) {
    EXPECT_FALSE(period.follow(2.0 * kStatedS));
    EXPECT_EQ(changes(period, kStatedS, 99), 0);
  }
  EXPECT_FALSE(period.follow(10.0 * kStatedS));
  EXPECT_EQ(period.in_use_s(), kStatedS);
}

/// 1.1 times the stated period is neither slow, nor as stated for a device that was slow.
TEST(ReadingPeriod, DoesNotAlternateBetweenTwoPeriods) {
  ReadingPeriod from_stated(kStatedS), from_slow(kStatedS);
  EXPECT_EQ(changes(from_stated, 1.1 * kStatedS, 1000), 0);
  (void)changes(from_slow, 2.0 * kStatedS, 1000);
  (void)changes(from_slow, 1.1 * kStatedS, 1000);
  EXPECT_TRUE(from_slow.is_slow());
  EXPECT_EQ(changes(from_slow, 1.1 * kStatedS, 1000), 0);
}

TEST(ReadingPeriod, CountsAPauseAsAShortInterval) {
  ReadingPeriod period(kStatedS);
  (void)period.follow(std::numeric_limits<double>::infinity());
  EXPECT_LT(period.in_use_s(), 2.0 * kStatedS);
}

}  // namespace
}  // namespace clay::falcon
