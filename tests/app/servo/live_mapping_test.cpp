#include "app/servo/controls.hpp"
#include "app/servo/mapping.hpp"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <cmath>
#include <glm/geometric.hpp>
#include <limits>

namespace clay::servo {
namespace {

double any(double low, double high) {
  return low + (high - low) * 1e-6 * static_cast<double>(*rc::gen::inRange(0, 1'000'001));
}

glm::dvec3 any_vector(double reach) {
  return {any(-reach, reach), any(-reach, reach), any(-reach, reach)};
}

MappingSettings any_settings() {
  MappingSettings s;
  s.scale = any(0.1, 10.0);
  s.force_gain = any(0.01, 10.0);
  s.side = *rc::gen::element(Side::right, Side::left, Side::front);
  s.flip_x = *rc::gen::arbitrary<bool>();
  s.flip_y = *rc::gen::arbitrary<bool>();
  s.flip_z = *rc::gen::arbitrary<bool>();
  return s;
}

RC_GTEST_PROP(Mapping, ToDeviceInvertsToClay, ()) {
  const Mapping mapping = Mapping::build(any_settings()).value();
  const glm::dvec3 at = any_vector(50.0);
  RC_ASSERT(glm::distance(mapping.to_device(mapping.to_clay(at)), at) < 1e-11);
}

RC_GTEST_PROP(Mapping, ForcesDoTheStatedShareOfTheWorkOfTheTool, ()) {
  const MappingSettings s = any_settings();
  const Mapping mapping = Mapping::build(s).value();
  const glm::dvec3 at = any_vector(50.0), motion = any_vector(1.0), force = any_vector(5.0);
  const double tool = glm::dot(force, mapping.to_clay(at + motion) - mapping.to_clay(at));
  const double hand = glm::dot(mapping.force_to_device(force), motion);
  RC_ASSERT(std::abs(hand - s.force_gain / s.scale * tool) < 1e-9);
}

RC_GTEST_PROP(Mapping, ClutchLeavesTheToolInPlace, ()) {
  Mapping mapping = Mapping::build(any_settings()).value();
  const glm::dvec3 tool = any_vector(100.0), hand = any_vector(50.0), motion = any_vector(5.0);
  const glm::dvec3 before = mapping.to_clay(hand + motion) - mapping.to_clay(hand);
  mapping.recentre(hand, tool);
  RC_ASSERT(glm::distance(mapping.to_clay(hand), tool) < 1e-11);
  RC_ASSERT(glm::distance(mapping.to_clay(hand + motion) - tool, before) < 1e-11);
}

TEST(Mapping, DefaultLetsAFalconReachAPotOf150Mm) {
  const Mapping mapping = Mapping::build({}).value();
  EXPECT_LE(mapping.to_clay({0, -48, 0}).y, 0.0);
  EXPECT_GE(mapping.to_clay({0, 48, 0}).y, 150.0);
  EXPECT_LT(mapping.to_clay({-48, 0, 0}).x, 0.0) << "past the axis";
  EXPECT_DOUBLE_EQ(mapping.stiffness_gain(), 1.0);
}

TEST(Mapping, MapsToTheChosenSide) {
  EXPECT_EQ(Mapping::build({.side = Side::right})->to_clay({}), glm::dvec3(60, 75, 0));
  EXPECT_EQ(Mapping::build({.side = Side::left})->to_clay({}), glm::dvec3(-60, 75, 0));
  EXPECT_EQ(Mapping::build({.side = Side::front})->to_clay({}), glm::dvec3(0, 75, 60));
  const Mapping flipped = Mapping::build({.flip_x = true}).value();
  EXPECT_EQ(flipped.to_clay({1, 0, 0}), glm::dvec3(58.4, 75, 0));
  EXPECT_EQ(flipped.force_to_device({1.6, 3.2, 0}), glm::dvec3(-1, 2, 0));
}

TEST(Mapping, RefusesUnusableSettings) {
  for (const double scale : {0.0, -1.0, 11.0, std::numeric_limits<double>::quiet_NaN()}) {
    const auto refused = Mapping::build({.scale = scale});
    ASSERT_FALSE(refused);
    EXPECT_NE(refused.error().message.find("scale: expected a value from 0.1 to 10"),
              std::string::npos);
  }
  EXPECT_FALSE(Mapping::build({.force_gain = 11.0}));
  EXPECT_FALSE(Mapping::build({.reach_mm = -1.0}));
}

// Friction of 1 N at 1 m/s injects 1 J per second. As a spring force it is damped.
TEST(HandForce, PassivityAppliesOnlyToTheSpring) {
  const Mapping mapping = Mapping::build({.scale = 1.0}).value();
  const auto max_removed_n = [&](bool as_spring) {
    HandForce hand(falcon::PassivityController::build({.loop = {}, .step_mm = 0.05}).value());
    double max_n = 0.0;
    for (int k = 0; k < 100; ++k) {
      StepReport clay;
      (as_spring ? clay.spring_n : clay.friction_n) = {0.0, 0.0, 1.0};
      const auto wanted = hand.answer(1000 * k, {0.0, 0.0, 1.0 * k}, mapping, clay);
      max_n = std::max(max_n, glm::distance(wanted.force_n, {0.0, 0.0, 1.0}));
      hand.displayed(wanted.force_n);
    }
    return max_n;
  };
  EXPECT_EQ(max_removed_n(false), 0.0);
  EXPECT_GT(max_removed_n(true), 0.5);
}

TEST(Controls, ButtonsHoldAndStep) {
  Commands commands;
  Controls controls(kFalconButtons, true, 5.0);
  controls.update(0, 4, commands);
  EXPECT_TRUE(controls.clutched());
  controls.update(0, 2 | 1, commands);
  EXPECT_FALSE(controls.clutched());
  EXPECT_TRUE(controls.trim());
  EXPECT_EQ(controls.gap_mm(), 5.5);
  controls.update(0, 1, commands);
  EXPECT_EQ(controls.gap_mm(), 5.5) << "one step per press";
  controls.update(0, 0, commands);
  for (int i = 0; i < 20; ++i) {
    controls.update(0, 8, commands);
    controls.update(0, 0, commands);
  }
  EXPECT_EQ(controls.gap_mm(), 0.0);
}

TEST(Controls, HeldButtonRepeats) {
  Commands commands;
  Controls controls(kFalconButtons, true, 5.0);
  // Pressed at 1 s and held for 1 s: a step for the press, one after 0.4 s, then twelve at 50 ms.
  for (std::int64_t us = 1'000'000; us <= 2'000'000; us += 1000) controls.update(us, 1, commands);
  EXPECT_DOUBLE_EQ(controls.gap_mm(), 5.0 + kGapStepMm * (1 + 1 + 12));
  controls.update(2'001'000, 0, commands);
  for (std::int64_t us = 2'002'000; us <= 2'300'000; us += 1000) controls.update(us, 8, commands);
  EXPECT_DOUBLE_EQ(controls.gap_mm(), 5.0 + kGapStepMm * (1 + 1 + 12 - 1));
}

TEST(Controls, HeldButtonDoesNotCatchUpAfterADelay) {
  Commands commands;
  Controls controls(kFalconButtons, true, 5.0);
  std::int64_t us = 1'000'000;
  for (; us <= 1'500'000; us += 1000) controls.update(us, 1, commands);
  const double before = controls.gap_mm();
  ASSERT_GT(before, 5.0 + kGapStepMm);
  us += 1'000'000;
  for (int tick = 0; tick < 30; ++tick) controls.update(us += 1000, 1, commands);
  EXPECT_LE(controls.gap_mm(), before + 2 * kGapStepMm);
  EXPECT_GT(controls.gap_mm(), before) << "it is still held";
}

TEST(Controls, CommandsHoldUntilReleased) {
  Commands commands;
  Controls controls(kTwoButtons, false, 5.0);
  EXPECT_EQ(controls.gap_mm(), 0.0) << "the scene does not allow a pinch";
  ASSERT_TRUE(commands.push({CommandKind::clutch, 1.0}));
  ASSERT_TRUE(commands.push({CommandKind::trim, 1.0}));
  ASSERT_TRUE(commands.push({CommandKind::gap, 3.0}));
  ASSERT_TRUE(commands.push({CommandKind::rearm, 0.0}));
  controls.update(0, 0, commands);
  EXPECT_TRUE(controls.clutched() && controls.trim() && controls.rearm());
  EXPECT_EQ(controls.gap_mm(), 0.0);
  controls.update(0, 0, commands);
  EXPECT_TRUE(controls.clutched());
  EXPECT_FALSE(controls.rearm()) << "for one tick";
  ASSERT_TRUE(commands.push({CommandKind::clutch, 0.0}));
  ASSERT_TRUE(commands.push({CommandKind::stop, 0.0}));
  controls.update(0, 0, commands);
  EXPECT_FALSE(controls.clutched());
  EXPECT_TRUE(controls.stopped());
}

TEST(Controls, NanDoesNotChangeTheGap) {
  Commands commands;
  Controls controls(kFalconButtons, true, 5.0);
  for (const double mm : {std::numeric_limits<double>::quiet_NaN(), -3.0}) {
    ASSERT_TRUE(commands.push({CommandKind::gap, mm}));
    controls.update(0, 0, commands);
    EXPECT_EQ(controls.gap_mm(), 5.0);
  }
  ASSERT_TRUE(commands.push({CommandKind::gap, 1e300}));
  controls.update(0, 0, commands);
  EXPECT_EQ(controls.gap_mm(), kWidestGapMm);
}

}  // namespace
}  // namespace clay::servo
