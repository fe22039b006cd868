// The guard in a closed loop, between an arm and a wall that is far too stiff.

#include "claystack/falcon/guard.hpp"
#include "claystack/falcon/passivity.hpp"
#include "claystack/falcon/sim.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <glm/geometric.hpp>
#include <utility>

namespace clay::falcon {
namespace {

constexpr std::int64_t kPeriodUs = 1000;
constexpr double kStepMm = 0.05;

struct Swing {
  double mm = 0.0;     ///< peak to peak, in the last second
  double max_n = 0.0;  ///< largest force sent
  GuardState state = GuardState::idle;
};

/// A hand that aims 5 mm inside a wall at z = 0, after the force has ramped up outside.
class Loop {
 public:
  explicit Loop(bool with_controller) : with_controller_(with_controller) {}
  /// A slow device: it reads its position and applies the force once in `ticks_per_frame` ticks.
  explicit Loop(int ticks_per_frame)
      : with_controller_(true),
        ticks_per_frame_(ticks_per_frame),
        arm_(held_arm({1000.0, 0.1, 0.002, ticks_per_frame})) {}

  Swing press(double stiffness_n_per_mm) {
    Swing swing;
    double low = 1e3, high = -1e3;
    for (int i = 0; i < 6000; ++i) {
      const GuardedForce out = tick(stiffness_n_per_mm);
      arm_.advance(out.force_n, {0.0, 0.0, i < 2500 ? 10.0 : -5.0});
      swing.max_n = std::max(swing.max_n, glm::length(out.force_n));
      swing.state = out.state;
      if (i < 5000) continue;
      low = std::min(low, arm_.position_mm().z);
      high = std::max(high, arm_.position_mm().z);
    }
    swing.mm = high - low;
    return swing;
  }

 private:
  GuardedForce tick(double stiffness_n_per_mm) {
    now_us_ += kPeriodUs;
    const glm::dvec3 at = arm_.reading_mm();
    const bool frame = now_us_ / kPeriodUs % ticks_per_frame_ == 0;
    (void)guard_.admit(now_us_, {now_us_, at, frame, true});
    wanted_.clay_time_us = now_us_;
    if (frame) {
      wanted_.force_n = {0.0, 0.0, std::max(0.0, -stiffness_n_per_mm * at.z)};
      if (with_controller_) {
        const PassiveForce passive = controller_.tick(now_us_, at, wanted_.force_n);
        wanted_.force_n = passive.force_n;
        wanted_.passive = passive.state != PassivityState::safe;
      }
    }
    const GuardedForce out = guard_.force(now_us_, wanted_);
    controller_.displayed(out.force_n);
    return out;
  }

  static SimulatedArm held_arm(const SampledLoop& loop) {
    return SimulatedArm::build({loop, 0.0, kStepMm}, {{}, glm::dvec3(0.1), glm::dvec3(0.0005)},
                               {0.0, 0.0, 10.0})
        .value();
  }

  static constexpr SampledLoop kLoop{1000.0, 0.1, 0.002, 1};
  bool with_controller_;
  int ticks_per_frame_ = 1;
  WantedForce wanted_;
  std::int64_t now_us_ = 0;
  ForceGuard guard_ = ForceGuard::build({}).value();
  SimulatedArm arm_ = held_arm(kLoop);
  PassivityController controller_ = PassivityController::build({kLoop, kStepMm}).value();
};

TEST(GuardLoop, RendersASoftWall) {
  const Swing swing = Loop(true).press(0.5);
  EXPECT_LT(swing.mm, 0.2);
  EXPECT_GT(swing.max_n, 0.3);
  EXPECT_EQ(swing.state, GuardState::engaged);
}

TEST(GuardLoop, LimitAloneBoundsTheImpactButNotTheVibration) {
  const Swing swing = Loop(false).press(1e3);
  EXPECT_LE(swing.max_n, 5.0);
  EXPECT_GT(swing.mm, 1.0);
}

TEST(GuardLoop, ControllerStopsTheVibration) {
  for (const double stiffness : {2.0, 10.0, 100.0, 1000.0}) {
    const Swing swing = Loop(true).press(stiffness);
    EXPECT_LE(swing.max_n, 5.0);
    EXPECT_LT(swing.mm, 0.2) << stiffness;
  }
}

/// The servo assumes 1000 Hz; the device gives 500, 250 and 200 Hz.
TEST(GuardLoop, DeviceSlowerThanStatedDoesNotVibrate) {
  for (const int ticks_per_frame : {2, 4, 5})
    for (const double stiffness : {0.6, 2.0, 10.0, 1000.0}) {
      const Swing swing = Loop(ticks_per_frame).press(stiffness);
      EXPECT_LT(swing.mm, 0.2) << ticks_per_frame << " " << stiffness;
      EXPECT_EQ(swing.state, GuardState::engaged);
    }
}

/// Swing [mm], after 17 s, of an arm that a hand pushes with 0.5 N into a wall of 10 N/mm. The
/// controller assumes kLoop; the arm has this delay and damping.
double swing_of(int delay_ticks, double damping_ns_per_mm, double hand_damping_ns_per_mm) {
  constexpr SampledLoop kLoop{1000.0, 0.1, 0.002, 1};
  SimulatedArm arm =
      SimulatedArm::build({{1000.0, 0.1, damping_ns_per_mm, delay_ticks}, 0.0, kStepMm},
                          {{-0.5, 0.0, 0.0}, glm::dvec3(0.0), glm::dvec3(hand_damping_ns_per_mm)},
                          {1.0, 0.0, 0.0})
          .value();
  PassivityController controller = PassivityController::build({kLoop, kStepMm}).value();
  double low = 1e3, high = -1e3;
  for (int i = 0; i < 20'000; ++i) {
    const glm::dvec3 at = arm.reading_mm();
    const glm::dvec3 wanted_n(std::clamp(-10.0 * at.x, 0.0, 5.0), 0.0, 0.0);
    arm.advance(controller.tick(kPeriodUs * i, at, wanted_n).force_n);
    if (i < 17'000) continue;
    low = std::min(low, arm.position_mm().x);
    high = std::max(high, arm.position_mm().x);
  }
  return high - low;
}

/// docs/haptics.md, "What it cannot see".
TEST(GuardLoop, MarginCoversOneTickOfDelayOrSomeOfTheDamping) {
  EXPECT_LT(swing_of(1, 0.002, 0.0), 0.2);
  EXPECT_LT(swing_of(2, 0.002, 0.0), 0.2);
  EXPECT_LT(swing_of(1, 0.0012, 0.0), 0.2);
  for (const auto& [delay_ticks, damping] : {std::pair{3, 0.002}, {1, 0.0005}}) {
    EXPECT_GT(swing_of(delay_ticks, damping, 0.0), 2.0) << delay_ticks;
    EXPECT_LT(swing_of(delay_ticks, damping, 0.003), 0.2) << delay_ticks << ": a hand damps it";
  }
}

}  // namespace
}  // namespace clay::falcon
