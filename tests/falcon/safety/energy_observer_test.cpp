#include "falcon/safety/energy_observer.hpp"

#include "falcon/safety/swing_counter.hpp"
#include "tests/falcon/safety/passivity_samples.hpp"

#include <gtest/gtest.h>

namespace clay::falcon {
namespace {

TEST(EnergyObserver, SumsForceTimesDistanceMinusDissipation) {
  EnergyObserver observer(kLoop, 0.0, 0.1);
  observer.observe(kTickS, along(0), along(0), along(1));
  double work = 0.0, damped = 0.0;
  for (const double distance : {-0.1, -0.2, -0.2, 0.1, 0.3, -0.2, 0.1, -0.1, 0.2}) {
    observer.observe(kTickS, along(1.5), along(distance), along(1));
    work += 1.5 * distance;
    damped += 0.002 * distance * distance / kTickS;  // at constant speed in each tick
  }
  EXPECT_NEAR(observer.injected_mj(), work - damped, 1e-15);
}

// An encoder measures a distance to one step, so the arm dissipates at least b (L - step)^2 / t.
TEST(EnergyObserver, CreditsTheWayToTheSurfaceLessOneStep) {
  constexpr double kStep = 0.05;
  EnergyObserver fast(kLoop, kStep, 0.1), slow(kLoop, kStep, 0.1);
  fast.observe(kTickS, along(0), along(-0.3), along(1));
  EXPECT_NEAR(fast.injected_mj(), -0.002 * 0.25 * 0.25 / kTickS, 1e-15);
  slow.observe(kTickS, along(0), along(-0.02), along(1));
  EXPECT_EQ(slow.injected_mj(), 0.0);
}

TEST(EnergyObserver, CreditsNothingToAHandAtRest) {
  EnergyObserver observer(kLoop, 0.05, 0.1);
  observer.observe(kTickS, along(0), along(-0.3), along(1));
  const double before = observer.injected_mj();
  for (int k = 0; k < 50; ++k) observer.observe(kTickS, along(0), along(0), along(1));
  EXPECT_EQ(observer.injected_mj(), before);
}

TEST(EnergyObserver, DropsCreditAfterTheContactAndKeepsDebt) {
  EnergyObserver observer({1000, 0.1, 0.0, 0}, 0.0, 0.1);
  const auto contact = [&observer](double in_mm, double in_n, double out_n) {
    observer.observe(kTickS, along(0), along(0), along(in_n));
    observer.observe(kTickS, along(in_n), along(-in_mm), along(out_n));
    const bool ended = observer.observe(kTickS, along(out_n), along(in_mm), along(0));
    EXPECT_TRUE(ended);
    EXPECT_FALSE(observer.in_contact());
  };
  contact(1.0, 3.0, 1.0);  // took 2 mJ
  EXPECT_EQ(observer.injected_mj(), 0.0);
  EXPECT_NEAR(observer.last_contact_mj(), -2.0, 1e-15);
  contact(1.0, 1.0, 3.0);  // gave 2 mJ
  EXPECT_NEAR(observer.injected_mj(), 2.0, 1e-15);
  contact(1.0, 1.0, 2.5);
  EXPECT_NEAR(observer.injected_mj(), 3.5, 1e-15);
  EXPECT_NEAR(observer.recent_mj(), 3.5, 1e-15);
  for (int k = 0; k < 107; ++k) observer.observe(kTickS, along(0), along(0), along(0));
  EXPECT_NEAR(observer.recent_mj(), 0.0, 1e-15);
  EXPECT_NEAR(observer.injected_mj(), 3.5, 1e-15);
}

TEST(EnergyObserver, CountsTheGainOfAContactBeforeItEnds) {
  EnergyObserver observer({1000, 0.1, 0.0, 0}, 0.0, 0.1);
  observer.observe(kTickS, along(0), along(0), along(1));
  observer.observe(kTickS, along(1), along(-1.0), along(3));
  EXPECT_EQ(observer.recent_mj(), 0.0);  // took 1 mJ
  observer.observe(kTickS, along(3), along(1.0), along(3));
  EXPECT_TRUE(observer.in_contact());
  EXPECT_NEAR(observer.recent_mj(), 2.0, 1e-15);
}

TEST(EnergyObserver, DetectsLoopsDespiteTheCreditOfALongPress) {
  // 5 mm at 4 N are 20 mJ of credit; then loops of 1 mm that give 1 N mm each.
  EnergyObserver observer({1000, 0.1, 0.0, 0}, 0.0, 0.1);
  observer.observe(kTickS, along(0), along(0), along(4));
  for (int k = 0; k < 5; ++k) observer.observe(kTickS, along(4), along(-1.0), along(4));
  for (int loop = 0; loop < 4; ++loop) {
    observer.observe(kTickS, along(4), along(1.0), along(4));
    observer.observe(kTickS, along(3), along(-1.0), along(4));
  }
  EXPECT_LT(observer.injected_mj(), -15.0);
  EXPECT_NEAR(observer.debt_mj(), 3.0, 1e-12);  // the fourth is not closed
  observer.forgive();
  EXPECT_EQ(observer.debt_mj(), 0.0);
}

// The first swing is the rise. The force falls back by 0.6 N from its maximum, not from the start
// of the swing.
TEST(SwingCounter, MeasuresASwingFromTheMaximum) {
  SwingCounter swings(2, 1.0, 0.5);
  double time_s = 0.0;
  for (const double force_n : {0.4, 0.8, 1.2, 1.6})
    EXPECT_FALSE(swings.swings_too_often(time_s += kTickS, along(force_n))) << force_n;
  EXPECT_FALSE(swings.swings_too_often(time_s += kTickS, along(1.2)));
  EXPECT_TRUE(swings.swings_too_often(time_s += kTickS, along(1.0)));
}

TEST(EnergyObserver, CountsNoEnergyForEncoderFlicker) {
  const double step = 0.05, k = 1.0;
  EnergyObserver observer(kLoop, step, 0.1);
  observer.observe(kTickS, along(0), along(0), along(1));
  observer.observe(kTickS, along(1), along(-20 * step), along(1));
  const double before = observer.injected_mj();
  for (int n = 0; n < 100; ++n) {  // each flicker appears to give k step^2
    observer.observe(kTickS, along(1), along(-step), along(1));
    observer.observe(kTickS, along(1 + k * step), along(step), along(1));
  }
  EXPECT_LE(observer.debt_mj(), observer.tolerance_mj());
  EXPECT_LE(observer.injected_mj(), before);
}

}  // namespace
}  // namespace clay::falcon
