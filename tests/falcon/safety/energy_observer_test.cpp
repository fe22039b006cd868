#include "tests/falcon/safety/passivity_samples.hpp"

#include <gtest/gtest.h>

namespace clay::falcon {
namespace {

TEST(EnergyObserver, SumsForceTimesDistanceMinusDissipation) {
  EnergyObserver observer(kLoop, 0.0, 0.1);
  observer.observe(kTickS, along(0), along(0), along(1));
  double work = 0.0, damped = 0.0;
  for (const double way : {-1e-4, -2e-4, -2e-4, 1e-4, 3e-4}) {
    observer.observe(kTickS, along(1.5), along(way), along(1));
    work += 1.5 * way;
    damped += 2.0 * way * way / kTickS;  // at constant speed in each tick
  }
  EXPECT_NEAR(observer.injected_j(), work - damped, 1e-18);
}

TEST(EnergyObserver, CreditEndsWithTheContactAndDebtRemains) {
  EnergyObserver observer({1000, 0.1, 0.0, 0}, 0.0, 0.1);
  const auto contact = [&observer](double way_in, double force_in, double force_out) {
    observer.observe(kTickS, along(0), along(0), along(force_in));
    observer.observe(kTickS, along(force_in), along(-way_in), along(force_out));
    const bool ended = observer.observe(kTickS, along(force_out), along(way_in), along(0));
    EXPECT_TRUE(ended);
    EXPECT_FALSE(observer.in_contact());
  };
  contact(1e-3, 3.0, 1.0);  // took 2 mJ
  EXPECT_EQ(observer.injected_j(), 0.0);
  EXPECT_NEAR(observer.last_contact_j(), -2e-3, 1e-18);
  contact(1e-3, 1.0, 3.0);  // gave 2 mJ
  EXPECT_NEAR(observer.injected_j(), 2e-3, 1e-18);
  contact(1e-3, 1.0, 2.5);
  EXPECT_NEAR(observer.injected_j(), 3.5e-3, 1e-18);
  EXPECT_NEAR(observer.recent_j(), 3.5e-3, 1e-18);
  for (int k = 0; k < 107; ++k) observer.observe(kTickS, along(0), along(0), along(0));
  EXPECT_NEAR(observer.recent_j(), 0.0, 1e-18);
  EXPECT_NEAR(observer.injected_j(), 3.5e-3, 1e-18);
}

TEST(EnergyObserver, DetectsLoopsDespiteTheCreditOfALongPress) {
  // 5 mm at 4 N are 20 mJ of credit; then loops of 1 mm that give 1 N mm each.
  EnergyObserver observer({1000, 0.1, 0.0, 0}, 0.0, 0.1);
  observer.observe(kTickS, along(0), along(0), along(4));
  for (int k = 0; k < 5; ++k) observer.observe(kTickS, along(4), along(-1e-3), along(4));
  for (int loop = 0; loop < 4; ++loop) {
    observer.observe(kTickS, along(4), along(1e-3), along(4));
    observer.observe(kTickS, along(3), along(-1e-3), along(4));
  }
  EXPECT_LT(observer.injected_j(), -15e-3);
  EXPECT_NEAR(observer.looped_j(), 3e-3, 1e-15);  // the fourth is not closed
  EXPECT_EQ(observer.debt_j(), observer.looped_j());
}

TEST(EnergyObserver, EncoderFlickerCountsNoEnergy) {
  const double step = 5e-5, k = 1000.0;
  EnergyObserver observer(kLoop, step, 0.1);
  observer.observe(kTickS, along(0), along(0), along(1));
  observer.observe(kTickS, along(1), along(-20 * step), along(1));
  const double before = observer.injected_j();
  for (int n = 0; n < 100; ++n) {  // each flicker seems to give k step^2
    observer.observe(kTickS, along(1), along(-step), along(1));
    observer.observe(kTickS, along(1 + k * step), along(step), along(1));
  }
  EXPECT_LE(observer.debt_j(), observer.tolerance_j());
  EXPECT_LE(observer.injected_j(), before);
}

}  // namespace
}  // namespace clay::falcon
