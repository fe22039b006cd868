#include "claystack/engine/wheel.hpp"

#include "tests/engine/clay/stack_samples.hpp"
#include "tests/support/allocation_counter.hpp"

#include <gtest/gtest.h>
#include <glm/geometric.hpp>

#include <cmath>
#include <limits>
#include <numbers>

namespace clay {
namespace {

using samples::scene_of;

/// A random hand that prefers difficult cases: the base, the rim, the axis, deep in the wall, jumps
/// and trimming; with occasional pinches if enabled.
class RestlessHand {
 public:
  explicit RestlessHand(std::uint64_t seed, bool pinches = false)
      : random_(seed), pinches_(pinches) {}

  Pose next(const ClayStack& stack) {
    if (samples::uniform(random_) < 0.002) choose(stack);
    const double speed = samples::uniform(random_) < 0.01 ? 5.0 : 0.1;
    for (int axis = 0; axis < 3; ++axis) {
      const double step = goal_[axis] - at_[axis];
      at_[axis] += std::clamp(step, -speed, speed) + 0.02 * (samples::uniform(random_) - 0.5);
    }
    if (samples::uniform(random_) < 0.01) trim_ = samples::uniform(random_) < 0.1;
    time_ += samples::uniform(random_) < 0.999 ? 1000 : 30'000;
    if (pinches_ && samples::uniform(random_) < 0.01)
      gap_ = std::max(0.0, 12.0 * samples::uniform(random_) - 4.0);
    return {time_, at_, trim_, gap_};
  }

 private:
  void choose(const ClayStack& stack) {
    const double height = stack.height_mm(), u = samples::uniform(random_);
    goal_.y = u < 0.2 ? 0.0 : u < 0.5 ? height + 2.0 : height * samples::uniform(random_);
    goal_.x = samples::uniform(random_) < 0.2 ? 0.0 : 45.0 * samples::uniform(random_);
    goal_.z = samples::uniform(random_) < 0.7 ? 0.0 : 10.0 * samples::uniform(random_);
  }
  std::mt19937_64 random_;
  glm::dvec3 at_{40.0, 20.0, 0.0}, goal_{28.0, 20.0, 0.0};
  std::int64_t time_ = 0;
  bool trim_ = false;
  bool pinches_;
  double gap_ = 0.0;
};

struct Outcome {
  int contacts = 0, grown = 0, trims = 0, expansive = 0, pinches = 0;
};

/// Plays a million ticks, in pots of twenty thousand, and checks the ledger after each.
template <class Check>
Outcome play_a_million(Model model, Check check) {
  Outcome outcome;
  for (std::uint64_t seed = 1; seed <= 50; ++seed) {
    SceneSpec scene = scene_of(model);
    if (seed % 5 == 0) scene.tool.mode = ToolMode::trim;
    if (seed % 3 == 0) scene.lump.inner_radius_mm = 20.0;
    const bool pinches = seed % 2 == 0;
    if (pinches) scene.tool.gap_mm = 4.0;
    if (seed % 8 == 0) scene.tool.mode = ToolMode::pinch;
    Wheel wheel = Wheel::build(scene).value();
    RestlessHand hand(seed, pinches);
    for (int k = 0; k < 20'000; ++k) {
      const Pose pose = hand.next(wheel.stack());
      const StepReport report = wheel.step(pose);
      const bool contact = (report.flags & kContact) != 0;
      outcome.contacts += contact;
      outcome.pinches += contact && pose.gap_mm > 0.0;
      outcome.grown += (report.flags & kGrew) != 0;
      if (!check(wheel)) {
        ADD_FAILURE() << "seed " << seed << ", tick " << k;
        return outcome;
      }
    }
    outcome.trims += wheel.ledger().trimmed > 0;
    outcome.expansive += wheel.stack().hollow();
  }
  return outcome;
}

bool rings_are_valid(const ClayStack& stack) {
  for (const Ring& ring : stack.rings())
    if (!(ring.inner2 >= 0 && ring.outer2 > ring.inner2)) return false;
  return stack.recount() == stack.volume() && stack.crown() >= 0;
}

void expect_coverage(const Outcome& outcome) {
  EXPECT_GT(outcome.contacts, 300'000);
  EXPECT_GT(outcome.grown, 100);
  EXPECT_GT(outcome.trims, 10);
  EXPECT_GT(outcome.pinches, 100'000);
  EXPECT_GT(outcome.expansive, 25);
}

TEST(Wheel, ConservingBalancesToTheQuantumAfterEveryTick) {
  expect_coverage(play_a_million(Model::conserving, [](const Wheel& wheel) {
    const WideQuanta counted = wheel.stack().recount();
    return wheel.ledger().imbalance(counted) == 0 && wheel.ledger().volume_error(counted) == 0 &&
           rings_are_valid(wheel.stack());
  }));
}

TEST(Wheel, PaperErrorIsBelowItsTopRingAfterEveryTick) {
  expect_coverage(play_a_million(Model::paper, [](const Wheel& wheel) {
    const WideQuanta counted = wheel.stack().recount(),
                     missing = -wheel.ledger().volume_error(counted);
    const bool room = wheel.stack().size() < wheel.stack().max_rings();
    return wheel.ledger().imbalance(counted) == 0 && missing >= 0 &&
           (!room || missing < wheel.stack().rings().back().volume()) &&
           rings_are_valid(wheel.stack());
  }));
}

TEST(Wheel, PaperErrorHalvesAsTheRingsDouble) {
  // One stroke up a lump of 60 mm, cut into N rings: the bound is one ring.
  const auto worst_percent = [](std::size_t rings) {
    SceneSpec scene = scene_of(Model::paper);
    scene.lump.rings = rings;
    scene.lump.ring_height_mm = 60.0 / static_cast<double>(rings);
    scene.lump.max_rings = 4 * rings;
    Wheel wheel = Wheel::build(scene).value();
    double worst = 0.0;
    for (int k = 0; k < 4000; ++k) {
      wheel.step({1000 * (k + 1), {36.5, 0.015 * k, 0.0}, false});
      const auto missing =
          static_cast<double>(-wheel.ledger().volume_error(wheel.stack().volume()));
      worst = std::max(worst, 100.0 * missing / static_cast<double>(wheel.ledger().initial));
    }
    return worst;
  };
  const double coarse = worst_percent(200), fine = worst_percent(400);
  EXPECT_GT(coarse, 0.5);  // the raised clay has made the top ring wider
  EXPECT_NEAR(fine / coarse, 0.5, 0.1);
}

TEST(Wheel, ReplayGivesTheSameBits) {
  for (const Model model : {Model::conserving, Model::paper}) {
    const auto play = [&] {
      Wheel wheel = Wheel::build(scene_of(model)).value();
      RestlessHand hand(7);
      glm::dvec3 impulse(0.0);
      for (int k = 0; k < 5000; ++k) impulse += wheel.step(hand.next(wheel.stack())).force_n();
      return std::pair(wheel.pot(), impulse);
    };
    EXPECT_TRUE(play() == play());
  }
}

TEST(Wheel, OptionalStagesDoNotMoveClay) {
  const auto play = [](auto edit) {
    SceneSpec scene = scene_of(Model::conserving);
    edit(scene);
    Wheel wheel = Wheel::build(scene).value();
    RestlessHand hand(11);
    for (int k = 0; k < 5000; ++k) wheel.step(hand.next(wheel.stack()));
    return wheel.stack();
  };
  const ClayStack all = play([](SceneSpec& s) { s.stability = StabilitySpec{1e6}; });
  EXPECT_TRUE(all == play([](SceneSpec& s) { s.force.reset(); }));
  EXPECT_TRUE(all == play([](SceneSpec& s) { s.force->friction = 0.0; }));
}

TEST(Wheel, ATickAllocatesNothing) {
  SceneSpec scene = scene_of(Model::conserving);
  scene.stability = StabilitySpec{1e6};
  Wheel wheel = Wheel::build(scene).value();
  RestlessHand hand(3);
  const std::size_t before = allocation_count();
  std::uint32_t seen = 0;
  for (int k = 0; k < 20'000; ++k) seen |= wheel.step(hand.next(wheel.stack())).flags;
  EXPECT_EQ(allocation_count(), before);
  EXPECT_TRUE(seen & kGrew);
}

TEST(Wheel, RefusedPoseChangesNothing) {
  Wheel wheel = Wheel::build(scene_of(Model::conserving)).value();
  ASSERT_TRUE(wheel.step({0, {34, 20, 0}, false}).flags & kContact);
  ASSERT_TRUE(wheel.step({1000, {34, 20, 0}, false}).flags & kContact);
  const Pot before = wheel.pot();
  const double nan = std::nan("");
  for (const Pose& bad : {Pose{2000, {nan, 20, 0}, false}, Pose{2000, {34, HUGE_VAL, 0}, false},
                          Pose{2000, {34, 20, 1e300}, false}, Pose{1000, {30, 20, 0}, false},
                          Pose{-5, {30, 20, 0}, false}}) {
    const StepReport report = wheel.step(bad);
    EXPECT_EQ(report.flags, kRefused);
    EXPECT_EQ(report.force_n(), glm::dvec3(0.0));
    EXPECT_TRUE(wheel.pot() == before);
  }
  EXPECT_TRUE(wheel.step({2000, {34, 20, 0}, false}).flags & kContact);
}

TEST(Wheel, ForceStaysWithinItsLimit) {
  SceneSpec scene = scene_of(Model::conserving);
  scene.force->stiffness_n_per_mm2 = 1e6;
  Wheel wheel = Wheel::build(scene).value();
  RestlessHand hand(5);
  double largest = 0.0;
  for (int k = 0; k < 5000; ++k)
    largest = std::max(largest, glm::length(wheel.step(hand.next(wheel.stack())).force_n()));
  EXPECT_LE(largest, 5.0);
  EXPECT_GT(largest, 4.99);
}

TEST(Wheel, FrictionIsAlongTheRotationAndTheSpringIsNot) {
  for (const Model model : {Model::conserving, Model::paper}) {
    SceneSpec scene = scene_of(model), frictionless = scene;
    frictionless.force->friction = 0.0;
    Wheel wheel = Wheel::build(scene).value(), without = Wheel::build(frictionless).value();
    RestlessHand hand(13);
    int compared = 0;
    for (int k = 0; k < 5000; ++k) {
      const Pose pose = hand.next(wheel.stack());
      const StepReport report = wheel.step(pose), spring = without.step(pose);
      const glm::dvec3 along(pose.position_mm.z, 0.0, -pose.position_mm.x);
      const double tolerance = 1e-9 * glm::length(along);
      ASSERT_EQ(spring.friction_n, glm::dvec3(0.0));
      ASSERT_NEAR(glm::dot(report.spring_n, along), 0.0, tolerance) << k;
      ASSERT_NEAR(glm::length(report.friction_n),
                  scene.force->friction * glm::length(report.spring_n), 1e-9)
          << k;
      ASSERT_LE(glm::length(glm::cross(report.friction_n, along)), tolerance) << k;
      if (glm::length(report.force_n()) >= 4.99) continue;
      ASSERT_EQ(report.spring_n, spring.spring_n) << k;
      compared += (report.flags & kContact) != 0;
    }
    EXPECT_GT(compared, 500);
  }
}

TEST(Wheel, CollapsesAtACutNeckAndThenStops) {
  SceneSpec scene = scene_of(Model::conserving);
  scene.stability = StabilitySpec{2.0};  // the lump itself reaches 0.73 kPa
  scene.tool.shape = SphereSpec{4.0};
  Wheel wheel = Wheel::build(scene).value();
  std::int64_t time = 0;
  std::uint32_t flags = 0;
  for (double x = 36.0; x > 2.0 && !(flags & kCollapsed); x -= 0.02)
    flags = wheel.step({time += 1000, {x, 10.2, 0}, false}).flags;
  ASSERT_TRUE(wheel.collapsed());
  const Pot pot = wheel.pot();
  ASSERT_TRUE(pot.collapse);
  EXPECT_NEAR(static_cast<double>(pot.collapse->failed_ring), 10.0, 1.0);
  EXPECT_EQ(pot.collapse->pivot_mm.y, 10.2);  // the HIP at the time of the collapse
  EXPECT_GT(pot.collapse->pivot_mm.x, 2.0);
  EXPECT_GT(pot.collapse->stress_kpa, 2.0);
  EXPECT_GT(pot.collapse->angle_rad, 0.0);
  EXPECT_EQ(wheel.step({time + 1000, {10, 20, 0}, false}).flags, kCollapsed);
  EXPECT_TRUE(wheel.pot() == pot);
  EXPECT_TRUE(pot.ledger.imbalance(pot.stack.recount()) == 0);
}

TEST(Wheel, ProbeMatchesStepWithoutChangingTheClay) {
  for (const Model model : {Model::conserving, Model::paper}) {
    Wheel probed = Wheel::build(scene_of(model)).value(),
          plain = Wheel::build(scene_of(model)).value();
    RestlessHand hand(7);
    Pose last{};
    int compared = 0;
    for (int i = 0; i < 20'000; ++i) {
      const Pose pose = hand.next(plain.stack());
      const StepReport before = probed.probe(pose);
      (void)probed.probe({pose.time_us, {30.0, 10.0, 0.0}});
      const StepReport after = probed.step(pose);
      ASSERT_EQ(plain.step(pose).force_n(), after.force_n()) << i;
      // A longer motion is played in parts, and the clay yields between them.
      const glm::dvec3 motion = glm::abs(pose.position_mm - last.position_mm);
      last = pose;
      if (std::max({motion.x, motion.y, motion.z}) >= 0.05) continue;
      ASSERT_EQ(before.force_n(), after.force_n()) << i;
      ASSERT_EQ(before.rings_touched, after.rings_touched) << i;
      compared += (before.flags & kContact) != 0;
    }
    EXPECT_GT(compared, 500);
    EXPECT_EQ(probed.pot(), plain.pot());
  }
}

TEST(Wheel, RefusesSettingsOutOfRange) {
  const auto message = [](auto edit) {
    SceneSpec scene = scene_of(Model::conserving);
    edit(scene);
    const auto wheel = Wheel::build(scene);
    return wheel ? std::string("accepted") : wheel.error().message;
  };
  const auto names = [&](const char* setting, auto edit) {
    EXPECT_NE(message(edit).find(setting), std::string::npos) << message(edit);
  };
  names("flow.inside_share", [](SceneSpec& s) { s.flow.inside_share = 1.1; });
  names("flow.sigma_mm", [](SceneSpec& s) { s.flow.sigma_mm = std::nan(""); });
  names("flow.sigma_mm: expected a value from 0 to 1e+09, found inf",
        [](SceneSpec& s) { s.flow.sigma_mm = std::numeric_limits<double>::infinity(); });
  names("flow.reach_mm", [](SceneSpec& s) { s.flow.reach_mm = 2e9; });
  names("removal.paper_fraction", [](SceneSpec& s) { s.removal.paper_fraction = 1.5; });
  names("removal.min_wall_mm", [](SceneSpec& s) { s.removal.min_wall_mm = 0.0; });
  names("force.limit_n", [](SceneSpec& s) { s.force->limit_n = 50.0; });
  names("force.friction", [](SceneSpec& s) { s.force->friction = -0.1; });
  names("lump.density_g_cm3", [](SceneSpec& s) { s.lump.density_g_cm3 = 0.0; });
  names("lump.rings", [](SceneSpec& s) { s.lump.rings = 0; });
  names("lump.max_rings", [](SceneSpec& s) {
    s.lump.max_rings = std::size_t{1} << 40;
    s.flow.reach_mm = 1e9;
  });
  names("lump.ring_height_mm", [](SceneSpec& s) { s.lump.ring_height_mm = -1.0; });
  names("lump: ", [](SceneSpec& s) { s.lump.outer_radius_mm = 1e6; });
  names("tool: ", [](SceneSpec& s) { s.tool.shape = SphereSpec{0.0}; });
  names("stability.max_stress_kpa", [](SceneSpec& s) { s.stability = StabilitySpec{0.01}; });
  // With enough digits to distinguish the number from the limit.
  names("to below 1, found 1", [](SceneSpec& s) { s.removal.paper_fraction = 1.0; });
  names("found 1e-09", [](SceneSpec& s) { s.lump.ring_height_mm = 1e-9; });
  names("found 1e+300", [](SceneSpec& s) { s.lump.outer_radius_mm = 1e300; });
}

}  // namespace
}  // namespace clay
