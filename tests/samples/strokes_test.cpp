#include "strokes.hpp"

#include "claystack/engine/session_file.hpp"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>
#include <complex>
#include <numbers>
#include <string>
#include <vector>

namespace clay::samples {
namespace {

/// One stroke that begins where the hand does; without tremor unless asked for.
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

/// The last `count` samples along one axis, less their mean.
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

/// Power of one frequency [Hz] in samples at 1 kHz, averaged over pieces of a second (Bartlett).
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

std::string message_of(std::string_view text) {
  const auto script = parse_strokes(text, "pot.strokes.json");
  return script ? "accepted" : script.error().message;
}

RC_GTEST_PROP(Strokes, PosesAdvanceByOneMillisecond, (std::uint64_t seed)) {
  StrokeScript script = script_through({{10.0, 10.0}, {20.0, 40.0}, {15.0, 60.0}}, 0.05);
  script.seed = seed;
  const auto poses = play(script);
  RC_ASSERT(poses.size() > 100u);
  for (std::size_t i = 0; i < poses.size(); ++i)
    RC_ASSERT(poses[i].time_us == static_cast<std::int64_t>(i) * 1000);
}

RC_GTEST_PROP(Strokes, TheHandIsNeverFasterThanStated, (std::uint64_t seed)) {
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
  // The bound is one that is come near: the pace differs by up to 10 % from stroke to stroke, and
  // the chord of a bend is shorter than the way.
  RC_ASSERT(fastest > 0.85 * script.strokes[0].speed_mm_s);
}

RC_GTEST_PROP(Strokes, APathPassesItsPoints, ()) {
  std::vector<glm::dvec2> through;
  for (int k = 0; k < 6; ++k)
    through.emplace_back(*rc::gen::inRange(0, 100), 20.0 * k + *rc::gen::inRange(0, 10));
  const auto poses = play(script_through(through));
  // Between two samples at 40 mm/s there are 0.04 mm.
  for (const glm::dvec2& point : through) RC_ASSERT(nearest(poses, point) <= 0.021);
}

TEST(Strokes, AStraightRowOfPointsIsAStraightPath) {
  // A long span next to a short one is where a uniform spline would run past the corner.
  const auto poses = play(script_through({{0.0, 100.0}, {0.0, 20.0}, {0.0, 19.0}, {30.0, 19.0}}));
  for (const Pose& pose : poses) {
    if (pose.position_mm.y > 20.0) {
      EXPECT_NEAR(pose.position_mm.x, 0.0, 0.5);
    }
    EXPECT_GE(pose.position_mm.y, 18.0);
  }
}

TEST(Strokes, APathIsTheSameBackward) {
  const std::vector<glm::dvec2> through{{0.0, 0.0}, {30.0, 0.0}, {35.0, 10.0}, {5.0, 60.0}};
  const auto forward = play(script_through(through));
  const auto backward = play(script_through({through.rbegin(), through.rend()}));
  for (std::size_t i = 0; i < backward.size(); i += 20)
    EXPECT_LE(nearest(forward, glm::dvec2(backward[i].position_mm)), 0.021);
}

TEST(Strokes, PassesAreShifted) {
  StrokeScript script = script_through({{10.0, 10.0}, {10.0, 30.0}});
  script.strokes[0].passes = 3;
  script.strokes[0].step_mm = {2.0, 1.0};
  const auto poses = play(script);
  for (int pass = 0; pass < 3; ++pass)
    EXPECT_LT(nearest(poses, {10.0 + 2.0 * pass, 30.0 + pass}), 1e-4);
}

TEST(Strokes, TheButtonIsPressedAlongTheStrokeAlone) {
  StrokeScript script = script_through({{10.0, 10.0}, {10.0, 30.0}});
  script.start_mm = {50.0, 20.0};
  script.strokes[0].passes = 2;
  script.strokes[0].trim = true;
  for (const Pose& pose : play(script)) {
    const glm::dvec2 at(pose.position_mm);
    if (glm::distance(at, script.strokes[0].through_mm.front()) < 0.01) continue;  // on both ways
    if (glm::distance(at, script.strokes[0].through_mm.back()) < 0.01) continue;
    EXPECT_EQ(pose.trim, at.x < 10.001) << at.x << ", " << at.y;
  }
}

TEST(Strokes, TremorIsAsLargeAsStated) {
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

RC_GTEST_PROP(Strokes, TheSeedDecidesThePoses, (std::uint64_t seed)) {
  StrokeScript script = script_through({{10.0, 10.0}, {20.0, 40.0}, {15.0, 60.0}}, 0.05);
  script.seed = seed;
  const auto poses = play(script);
  RC_ASSERT(play(script) == poses);
  ++script.seed;
  RC_ASSERT(play(script) != poses);
}

TEST(Strokes, PosesAreCountedAsInASession) {
  for (const Pose& pose : play(script_through({{10.0, 10.0}, {20.0, 40.0}}, 0.05)))
    ASSERT_EQ(quantized(pose), pose);
}

TEST(StrokeFile, ReadsEveryField) {
  const auto script = parse_strokes(
      R"({"seed": 5, "rate_hz": 500, "tremor_mm": 0.1, "travel_mm_s": 250, "start_mm": [90, 120],
          "strokes": [{"through_mm": [[1, 2], [3, 4]], "speed_mm_s": 30, "passes": 2,
                       "step_mm": [0, -1], "hold_s": 0.5, "trim": true},
                      {"through_mm": [[5, 6], [7, 8]]}]})",
      "pot.strokes.json");
  ASSERT_TRUE(script) << script.error().message;
  EXPECT_EQ(script->seed, 5u);
  EXPECT_EQ(script->rate_hz, 500.0);
  EXPECT_EQ(script->tremor_mm, 0.1);
  EXPECT_EQ(script->travel_mm_s, 250.0);
  EXPECT_EQ(script->start_mm, glm::dvec2(90.0, 120.0));
  ASSERT_EQ(script->strokes.size(), 2u);
  const Stroke& stroke = script->strokes[0];
  EXPECT_EQ(stroke.through_mm, (std::vector<glm::dvec2>{{1.0, 2.0}, {3.0, 4.0}}));
  EXPECT_EQ(stroke.speed_mm_s, 30.0);
  EXPECT_EQ(stroke.passes, 2);
  EXPECT_EQ(stroke.step_mm, glm::dvec2(0.0, -1.0));
  EXPECT_EQ(stroke.hold_s, 0.5);
  EXPECT_TRUE(stroke.trim);
  EXPECT_EQ(script->strokes[1].passes, 1);
}

TEST(StrokeFile, SaysWhatIsWrongAndWhere) {
  const auto with = [](const std::string& stroke) {
    return message_of(R"({"start_mm": [9, 9], "strokes": [{"through_mm": [[1, 2], [3, 4]]}, )" +
                      stroke + "]}");
  };
  EXPECT_EQ(with(R"({"through_mm": [[1, 2], [3, 4]], "spede_mm_s": 3})"),
            "pot.strokes.json: strokes[1].spede_mm_s: unknown field");
  EXPECT_EQ(
      with(R"({"through_mm": [[1, 2], [3, 4]], "speed_mm_s": "fast"})"),
      R"(pot.strokes.json: strokes[1].speed_mm_s: expected a number from 1.0 to 10000.0, found "fast")");
  EXPECT_EQ(with(R"({"through_mm": [[1, 2], [3, 4]], "hold_s": 61})"),
            "pot.strokes.json: strokes[1].hold_s: expected a number from 0.0 to 60.0, found 61");
  EXPECT_EQ(with(R"({"through_mm": []})"),
            "pot.strokes.json: strokes[1].through_mm: expected an array of 2 at least, found an "
            "array of 0");
  EXPECT_EQ(with(R"({"speed_mm_s": 3})"),
            "pot.strokes.json: strokes[1].through_mm: expected a field, found none");
  EXPECT_EQ(with(R"({"through_mm": [[1, 2], [3, null]]})"),
            "pot.strokes.json: strokes[1].through_mm[1][1]: expected a number from -1000.0 to "
            "1000.0, found null");
  EXPECT_EQ(with(R"({"through_mm": [[1, 2], [3]]})"),
            "pot.strokes.json: strokes[1].through_mm[1]: expected an array of 2 numbers, found an "
            "array of 1");
  EXPECT_EQ(with(R"({"through_mm": [[1, 2], [1, 2]]})"),
            "pot.strokes.json: strokes[1].through_mm: expected neighbours apart, found two equal");
  EXPECT_EQ(with(R"({"through_mm": [[1, 2], [3, 4]], "passes": 0})"),
            "pot.strokes.json: strokes[1].passes: expected an integer from 1 to 100, found 0");
  EXPECT_EQ(with(R"({"through_mm": [[1, 2], [3, 4]], "passes": -1})"),
            "pot.strokes.json: strokes[1].passes: expected an integer from 1 to 100, found -1");
  EXPECT_EQ(with(R"({"through_mm": [[1, 2], [3, 4]], "trim": 1})"),
            "pot.strokes.json: strokes[1].trim: expected true or false, found 1");
  EXPECT_EQ(with("7"), "pot.strokes.json: strokes[1]: expected an object, found 7");
}

TEST(StrokeFile, SaysWhatIsWrongWithTheWhole) {
  EXPECT_EQ(message_of("[]"), "pot.strokes.json: expected an object, found an array of 0");
  EXPECT_EQ(message_of(R"({"strokes": []})"),
            "pot.strokes.json: start_mm: expected a field, found none");
  EXPECT_EQ(message_of(R"({"start_mm": [9, 9], "strokes": []})"),
            "pot.strokes.json: strokes: expected an array of 1 at least, found an array of 0");
  EXPECT_EQ(
      message_of(
          R"({"start_mm": [9, 9], "tempo": 1, "strokes": [{"through_mm": [[1, 2], [3, 4]]}]})"),
      "pot.strokes.json: tempo: unknown field");
  const std::string torn = message_of(R"({"start_mm": [9, 9)");
  EXPECT_TRUE(torn.starts_with("pot.strokes.json: ")) << torn;
  EXPECT_NE(torn.find("line 1"), std::string::npos) << torn;
}

}  // namespace
}  // namespace clay::samples
