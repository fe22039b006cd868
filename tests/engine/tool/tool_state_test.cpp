#include "engine/tool/tool_state.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace clay {
namespace {

Pose at(std::int64_t us, double y) { return {us, {60.0, y, 0.0}, false}; }

TEST(ToolTracker, KeepsTheLastNonzeroDirection) {
  ToolTracker tracker;
  EXPECT_TRUE(tracker.advance(at(0, 10)).upward);  // before any motion: up
  EXPECT_TRUE(tracker.advance(at(1000, 10)).upward);
  EXPECT_FALSE(tracker.advance(at(2000, 9)).upward);
  for (int k = 3; k < 100; ++k) EXPECT_FALSE(tracker.advance(at(k * 1000, 9)).upward);
  EXPECT_TRUE(tracker.advance(at(100'000, 9.0001)).upward);
}

TEST(ToolTracker, MeasuresTimeAndClampsIt) {
  ToolTracker tracker;
  EXPECT_EQ(tracker.advance(at(500, 0)).dt_s, 0.0);
  EXPECT_NEAR(tracker.advance(at(1500, 0)).dt_s, 1e-3, 1e-15);
  const ToolState late = tracker.advance(at(1'001'500, 0));
  EXPECT_NEAR(late.dt_s, 0.05, 1e-15);
  EXPECT_TRUE(late.dt_clamped);
}

/// Over a second and at any rate, each period of 3 ms is counted once, and the phase is that of the
/// clock.
TEST(ToolTracker, CountsPeriodsOfTheClockOnce) {
  for (const int step_us : {250, 999, 1000, 8000, 16'667}) {
    ToolTracker tracker;
    double slow_s = 0.0;
    std::int64_t us = -500'000;
    for (tracker.advance(at(us, 0)); us < 500'000;) {
      const ToolState state = tracker.advance(at(us += step_us, 0));
      slow_s += state.slow_s;
      const double phase = std::remainder(1e-6 * static_cast<double>(us) - state.phase_s, 0.009);
      EXPECT_NEAR(phase, 0.0, 1e-9) << us;
    }
    // From the last multiple of 3 ms before -0.5 s to the last before the end.
    const auto end_ms = static_cast<double>(us / 3000 * 3);
    EXPECT_NEAR(slow_s, 1e-3 * (end_ms + 501.0), 1e-9) << step_us;
  }
}

TEST(ToolTracker, RefusesInvalidPoses) {
  ToolTracker tracker;
  ASSERT_TRUE(tracker.advance(at(0, 5)).valid);
  ASSERT_TRUE(tracker.advance(at(1000, 6)).valid);
  EXPECT_FALSE(tracker.advance(at(1000, 7)).valid);  // time stands still
  EXPECT_FALSE(tracker.advance(at(0, 7)).valid);     // time runs backwards
  EXPECT_FALSE(tracker.advance(at(std::numeric_limits<std::int64_t>::min(), 7)).valid);
  for (const double bad : {std::nan(""), HUGE_VAL, -HUGE_VAL, 1e300, 1.0001e6})
    for (int axis = 0; axis < 3; ++axis) {
      Pose pose = at(2000, 0);
      pose.position_mm[axis] = bad;
      EXPECT_FALSE(tracker.advance(pose).valid);
    }
  // None of them moved the tool or advanced the time.
  const ToolState next = tracker.advance(at(2000, 6));
  EXPECT_TRUE(next.valid && next.upward);
  EXPECT_NEAR(next.dt_s, 1e-3, 1e-15);
}

TEST(ToolTracker, ExtremeTimesDoNotOverflow) {
  ToolTracker tracker;
  ASSERT_TRUE(tracker.advance(at(std::numeric_limits<std::int64_t>::min(), 0)).valid);
  EXPECT_TRUE(tracker.advance(at(std::numeric_limits<std::int64_t>::max(), 0)).dt_clamped);
}

}  // namespace
}  // namespace clay
