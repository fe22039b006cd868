#include "app/strokes/strokes.hpp"

#include "claystack/engine/files.hpp"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>
#include <complex>
#include <numbers>
#include <string>
#include <vector>

namespace clay::strokes {
namespace {

/// On a lump that the strokes of these tests may touch or not: their poses do not depend on it.
std::vector<Pose> play(const StrokeScript& script) {
  SceneSpec scene;
  scene.lump = {.rings = 10, .ring_height_mm = 1.0, .outer_radius_mm = 5.0};
  scene.tool.gap_mm = 4.0;
  return strokes::play(script, scene, Wheel::build(scene).value()).value().poses;
}

/// On the usual lump, for one tool.
Result<Played> play_on_lump(const StrokeScript& script, std::size_t most_poses = kMaxPoses) {
  const SceneSpec scene;
  return strokes::play(script, scene, Wheel::build(scene).value(), most_poses);
}

/// One stroke that begins at the hand's start; without tremor unless set.
StrokeScript script_through(std::vector<glm::dvec2> through_mm, double tremor_mm = 0.0) {
  StrokeScript script;
  script.tremor_mm = tremor_mm;
  script.start_mm = through_mm.front();
  script.strokes.emplace_back();
  script.strokes[0].through_mm = std::move(through_mm);
  return script;
}

StrokeScript resting_script(double tremor_mm, std::uint64_t seed) {
  StrokeScript script = script_through({{50.0, 50.0}, {51.0, 50.0}}, tremor_mm);
  script.seed = seed;
  script.strokes[0].hold_s = 40.0;
  return script;
}

/// The last `count` samples along one axis, minus their mean.
std::vector<double> deviations(const std::vector<Pose>& poses, glm::length_t axis,
                               std::size_t count) {
  std::vector<double> values;
  double sum = 0.0;
  for (std::size_t i = poses.size() - count; i < poses.size(); ++i) {
    values.push_back(poses[i].position_mm[axis]);
    sum += values.back();
  }
  for (double& value : values) value -= sum / static_cast<double>(count);
  return values;
}

/// Power of one frequency [Hz] in samples at 1 kHz, averaged over segments of a second (Bartlett).
double power_at(const std::vector<double>& values, double frequency_hz) {
  constexpr std::size_t kPiece = 1000;
  double power = 0.0;
  for (std::size_t first = 0; first + kPiece <= values.size(); first += kPiece) {
    std::complex<double> sum = 0.0;
    for (std::size_t i = 0; i < kPiece; ++i) {
      const double turn = 2.0 * std::numbers::pi * frequency_hz * static_cast<double>(i) / kPiece;
      sum += values[first + i] * std::polar(1.0, turn);
    }
    power += std::norm(sum);
  }
  return power;
}

double nearest(const std::vector<Pose>& poses, glm::dvec2 point) {
  double least = 1e9;
  for (const Pose& pose : poses)
    least = std::min(least, glm::distance(glm::dvec2(pose.position_mm), point));
  return least;
}

RC_GTEST_PROP(Strokes, PosesAdvanceByOneMillisecond, (std::uint64_t seed)) {
  StrokeScript script = script_through({{10.0, 10.0}, {20.0, 40.0}, {15.0, 60.0}}, 0.05);
  script.seed = seed;
  const auto poses = play(script);
  RC_ASSERT(poses.size() > 100u);
  for (std::size_t i = 0; i < poses.size(); ++i)
    RC_ASSERT(poses[i].time_us == static_cast<std::int64_t>(i) * 1000);
}

RC_GTEST_PROP(Strokes, HandNeverExceedsTheStatedSpeed, (std::uint64_t seed)) {
  std::vector<glm::dvec2> through;
  for (int k = 0; k < 5; ++k) through.emplace_back(30.0 * k, *rc::gen::inRange(0, 150));
  StrokeScript script = script_through(through);
  script.seed = seed;
  script.start_mm = {200.0, 200.0};
  script.travel_mm_s = 300.0;
  script.strokes[0].speed_mm_s = *rc::gen::inRange(20, 300);
  const auto poses = play(script);

  const auto begins = std::ranges::find_if(poses, [&](const Pose& pose) {
    return glm::distance(glm::dvec2(pose.position_mm), through.front()) < 1e-4;
  });
  RC_ASSERT(begins != poses.end());
  const auto first = static_cast<std::size_t>(begins - poses.begin());
  double fastest = 0.0;
  for (std::size_t i = 1; i < poses.size(); ++i) {
    const double speed = 1000.0 * glm::distance(poses[i].position_mm, poses[i - 1].position_mm);
    // Two roundings to 2^-16 mm within a millisecond.
    RC_ASSERT(speed <= (i <= first ? script.travel_mm_s : script.strokes[0].speed_mm_s) + 0.05);
    if (i > first) fastest = std::max(fastest, speed);
  }
  // The bound is nearly reached: the speed varies by up to 10 % between strokes, and the chord of a
  // bend is shorter than its arc.
  RC_ASSERT(fastest > 0.85 * script.strokes[0].speed_mm_s);
}

RC_GTEST_PROP(Strokes, PathPassesThroughItsPoints, ()) {
  std::vector<glm::dvec2> through;
  for (int k = 0; k < 6; ++k)
    through.emplace_back(*rc::gen::inRange(0, 100), 20.0 * k + *rc::gen::inRange(0, 10));
  const auto poses = play(script_through(through));
  // Samples at 40 mm/s are 0.04 mm apart.
  for (const glm::dvec2& point : through) RC_ASSERT(nearest(poses, point) <= 0.021);
}

TEST(Strokes, CollinearPointsGiveAStraightPath) {
  // A long span next to a short one, where a uniform spline would overshoot the corner.
  const auto poses = play(script_through({{0.0, 100.0}, {0.0, 20.0}, {0.0, 19.0}, {30.0, 19.0}}));
  for (const Pose& pose : poses) {
    if (pose.position_mm.y > 20.0) {
      EXPECT_NEAR(pose.position_mm.x, 0.0, 0.5);
    }
    EXPECT_GE(pose.position_mm.y, 18.0);
  }
}

TEST(Strokes, PathIsTheSameBackward) {
  const std::vector<glm::dvec2> through{{0.0, 0.0}, {30.0, 0.0}, {35.0, 10.0}, {5.0, 60.0}};
  const auto forward = play(script_through(through));
  const auto backward = play(script_through({through.rbegin(), through.rend()}));
  for (std::size_t i = 0; i < backward.size(); i += 20)
    EXPECT_LE(nearest(forward, glm::dvec2(backward[i].position_mm)), 0.021);
}

TEST(Strokes, ShiftsRepeatedPasses) {
  StrokeScript script = script_through({{10.0, 10.0}, {10.0, 30.0}});
  script.strokes[0].passes = 3;
  script.strokes[0].step_mm = {2.0, 1.0};
  const auto poses = play(script);
  for (int pass = 0; pass < 3; ++pass)
    EXPECT_LT(nearest(poses, {10.0 + 2.0 * pass, 30.0 + pass}), 1e-4);
}

TEST(Strokes, PressesTheButtonDuringTheStrokeOnly) {
  StrokeScript script = script_through({{10.0, 10.0}, {10.0, 30.0}});
  script.start_mm = {50.0, 20.0};
  script.strokes[0].passes = 2;
  script.strokes[0].trim = true;
  for (const Pose& pose : play(script)) {
    const glm::dvec2 at(pose.position_mm);
    if (glm::distance(at, script.strokes[0].through_mm.front()) < 0.01)
      continue;  // both lines contain it
    if (glm::distance(at, script.strokes[0].through_mm.back()) < 0.01) continue;
    EXPECT_EQ(pose.trim, at.x < 10.001) << at.x << ", " << at.y;
  }
}

TEST(Strokes, InterpolatesTheGapLinearly) {
  // For equidistant points on a line the spline is that line at uniform speed.
  StrokeScript script = script_through({{10.0, 10.0}, {10.0, 30.0}, {10.0, 50.0}});
  script.start_mm = {50.0, 20.0};
  script.strokes[0].gap_mm = {20.0, 4.0, 5.0};
  std::size_t along = 0;
  for (const Pose& pose : play(script)) {
    const double y = pose.position_mm.y;
    if (pose.position_mm.x > 10.001) {
      EXPECT_EQ(pose.gap_mm, 0.0);  // between strokes the hand is one tool
    } else if (y > 10.001) {
      const double expected = y < 30.0 ? 20.0 - 0.8 * (y - 10.0) : 4.0 + 0.05 * (y - 30.0);
      EXPECT_NEAR(pose.gap_mm, expected, 1e-4) << y;
      ++along;
    }
  }
  EXPECT_GT(along, 100u);
}

TEST(Strokes, HoldsAGapToTheEnd) {
  StrokeScript script = script_through({{10.0, 10.0}, {10.0, 30.0}});
  script.strokes[0].gap_mm = {4.0};
  script.strokes[0].hold_s = 0.5;
  const auto poses = play(script);
  EXPECT_EQ(std::ranges::count(poses, 4.0, &Pose::gap_mm),
            std::ranges::count_if(poses, [](const Pose& pose) { return pose.gap_mm > 0.0; }));
  EXPECT_EQ(poses.back().gap_mm, 4.0);
}

TEST(Strokes, TremorHasTheStatedAmplitude) {
  constexpr double kTremorMm = 0.2;
  const auto poses = play(resting_script(kTremorMm, 7));
  for (const glm::length_t axis : {0, 1, 2}) {
    double square = 0.0;
    const auto values = deviations(poses, axis, 40'000);
    for (const double value : values) square += value * value;
    // 40 s of noise 6 Hz wide are some 240 independent samples: 5 % standard deviation at most.
    EXPECT_NEAR(std::sqrt(square / static_cast<double>(values.size())), kTremorMm, 0.2 * kTremorMm);
  }
}

TEST(Strokes, TremorPeaksNearNineHertz) {
  const auto values = deviations(play(resting_script(0.2, 11)), 1, 40'000);
  double best = 0.0, best_hz = 0.0;
  for (double hz = 1.0; hz <= 60.0; hz += 1.0) {
    const double power = power_at(values, hz);
    if (power > best) {
      best = power;
      best_hz = hz;
    }
  }
  EXPECT_NEAR(best_hz, 9.0, 2.0);
  EXPECT_GT(best, 20.0 * power_at(values, 40.0));
}

RC_GTEST_PROP(Strokes, SeedDeterminesThePoses, (std::uint64_t seed)) {
  StrokeScript script = script_through({{10.0, 10.0}, {20.0, 40.0}, {15.0, 60.0}}, 0.05);
  script.seed = seed;
  const auto poses = play(script);
  RC_ASSERT(play(script) == poses);
  ++script.seed;
  RC_ASSERT(play(script) != poses);
}

TEST(Strokes, RefusesAGapInASceneOfOneTool) {
  StrokeScript script = script_through({{10.0, 10.0}, {10.0, 30.0}});
  script.strokes.push_back(script.strokes[0]);
  script.strokes[1].gap_mm = {4.0};
  const auto refused = play_on_lump(script);
  ASSERT_FALSE(refused);
  EXPECT_EQ(refused.error().message,
            "strokes[1].gap_mm: expected one tool, because the scene sets no tool.gap_mm, found a "
            "gap between two");
}

/// The length of a planned stroke is known only when it is played.
TEST(Strokes, RefusesMorePosesThanTheLimit) {
  const StrokeScript script = script_through({{10.0, 10.0}, {10.0, 30.0}});
  const std::size_t count = play_on_lump(script)->poses.size();
  EXPECT_EQ(play_on_lump(script, count)->poses.size(), count);
  const auto refused = play_on_lump(script, count - 1);
  ASSERT_FALSE(refused);
  EXPECT_EQ(refused.error().message,
            "strokes: expected at most " + std::to_string(count - 1) + " poses, found more");
}

TEST(Strokes, QuantizesPosesLikeASession) {
  for (const Pose& pose : play(script_through({{10.0, 10.0}, {20.0, 40.0}}, 0.05)))
    ASSERT_EQ(quantized(pose), pose);
}

}  // namespace
}  // namespace clay::strokes
