// The simulated hand of `throw --device simulated` on a virtual clock. It must throw the pot of the
// session that it plays.

#include "tests/app/servo/live_bench.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>

namespace clay::servo {
namespace {

constexpr double kReachMm = 46.0;
constexpr double kEncoderStepMm = 0.05;  // in the middle of the workspace

double scale_of(const std::string& name) { return fitted({}, sample_stroke(name), kReachMm).scale; }

/// A sample whose clay yields at once, so that it does not hold the hand back.
SceneSpec soft_scene(const std::string& name) {
  SceneSpec scene = sample_scene(name);
  scene.removal.yield_depth_mm = 0.25;
  return scene;
}

/// A whole session thrown by the simulated hand.
Wheel thrown(const std::string& name) {
  const SceneSpec scene = soft_scene(name);
  const std::vector<Pose> stroke = sample_stroke(name);
  LiveSettings settings;
  settings.mapping = fitted({}, stroke, kReachMm);
  settings.seconds = seconds_of(stroke);
  auto potter = simulated_potter(stroke, Mapping::build(settings.mapping).value());
  potter.clock = falcon::SimClock::stepped;
  auto simulated = make_simulated_falcon(potter).value();
  EXPECT_TRUE(simulated.device->open());
  Wheel wheel = Wheel::build(scene).value();
  LineClock clock(*simulated.line);
  auto loop = ServoLoop::build({wheel, *simulated.device, clock}, settings).value();
  loop.start();
  falcon::ForceGate gate;
  Commands commands;
  LiveView view;
  std::atomic<std::int64_t> heartbeat_us{0};
  Ending ending = Ending::none;
  while (ending == Ending::none) ending = loop.tick(gate, commands, view, heartbeat_us);
  EXPECT_EQ(ending, wheel.collapsed() ? Ending::collapsed : Ending::time_up);
  EXPECT_EQ(loop.events().safe[static_cast<std::size_t>(falcon::SafeCause::jumped)], 0u);
  return wheel;
}

Wheel replayed(const std::string& name) {
  Wheel wheel = Wheel::build(soft_scene(name)).value();
  for (const Pose& pose : sample_stroke(name)) wheel.step(pose);
  return wheel;
}

/// Root mean square difference of the outer and inner radii of the rings that both have.
double difference_mm(const Wheel& a, const Wheel& b) {
  const auto rings_a = a.stack().rings(), rings_b = b.stack().rings();
  const std::size_t size = std::min(rings_a.size(), rings_b.size());
  double sum = 0.0;
  for (std::size_t i = 0; i < size; ++i)
    sum += std::pow(rings_a[i].outer_mm() - rings_b[i].outer_mm(), 2) +
           std::pow(rings_a[i].inner_mm() - rings_b[i].inner_mm(), 2);
  return std::sqrt(sum / (2.0 * static_cast<double>(size)));
}

TEST(SimulatedPotter, ThrowsThePotOfTheSession) {
  // The vase and the cylinder are trimmed; the cylinder is also pinched.
  for (const char* name : {"bowl", "vase", "bottle", "cylinder"}) {
    const Wheel live = thrown(name), recorded = replayed(name);
    EXPECT_LT(difference_mm(live, recorded), 1.0) << name;
    EXPECT_NEAR(live.stack().height_mm(), recorded.stack().height_mm(),
                0.02 * recorded.stack().height_mm())
        << name;
    const auto trimmed = [](const Wheel& wheel) {
      return wheel.stack().mm3_per_quantum() * static_cast<double>(wheel.ledger().trimmed);
    };
    // An encoder step in the tool position changes the cut by a skin one step thick, and so do the
    // earlier strokes. The trimmed foot of either pot has at most 50 mm radius and 41 mm height.
    const double skin_mm3 =
        2.0 * kEncoderStepMm * scale_of(name) * 2.0 * std::numbers::pi * 50.0 * 41.0;
    EXPECT_NEAR(trimmed(live), trimmed(recorded), trimmed(recorded) > 0.0 ? skin_mm3 : 0.0) << name;
    EXPECT_EQ(live.ledger().volume_error(live.stack().recount()), 0);
  }
}

TEST(SimulatedPotter, PlaysButtonAndGapOfTheSession) {
  const std::vector<Pose> poses = {{0, {60, 50, 0}, false, 0.0},
                                   {10'000, {60, 50, 0}, true, 0.0},
                                   {20'000, {60, 50, 0}, true, 12.5},
                                   {30'000, {60, 50, 0}, false, 0.0}};
  const auto fingers = hand_fingers(poses);
  const auto at = [&](double ms) { return fingers(kHandLeadS + 1e-3 * ms); };
  EXPECT_EQ(at(-1).buttons, 0u);
  EXPECT_EQ(at(5), (falcon::Fingers{0, 0.0}));
  EXPECT_EQ(at(15), (falcon::Fingers{static_cast<std::uint8_t>(kFalconButtons.trim), 0.0}));
  EXPECT_EQ(at(25), (falcon::Fingers{static_cast<std::uint8_t>(kFalconButtons.trim), 12.5}));
  EXPECT_EQ(at(1000), (falcon::Fingers{0, 0.0}));
  EXPECT_FALSE(hand_fingers({}));
}

TEST(SimulatedPotter, KeepsTheWholeStrokeWithinReach) {
  for (const char* name : {"bowl", "vase", "bottle", "cylinder", "collapse"}) {
    const std::vector<Pose> stroke = sample_stroke(name);
    const auto mapping = Mapping::build(fitted({}, stroke, kReachMm)).value();
    const falcon::Kinematics arm(falcon::kLibnifalconGeometry);
    for (const Pose& pose : stroke) {
      const glm::dvec3 at_mm = mapping.to_device(pose.position_mm);
      ASSERT_LE(glm::length(at_mm), kReachMm + 1e-9) << name;
      ASSERT_TRUE(arm.inverse(falcon::kFalconCentreMm + at_mm)) << name;
    }
  }
  EXPECT_EQ(fitted({}, {}, kReachMm), MappingSettings{});
  const std::vector<Pose> small = {{0, {59, 74, 0}}, {1000, {61, 76, 0}}};
  EXPECT_EQ(fitted({}, small, kReachMm), MappingSettings{}) << "the default mapping is enough";
}

}  // namespace
}  // namespace clay::servo
