#include "app/strokes/strokes.hpp"

#include <gtest/gtest.h>

#include <cstdint>
#include <string>
#include <string_view>
#include <tuple>
#include <vector>

namespace clay::strokes {
namespace {

std::string message_of(std::string_view text) {
  const auto script = parse_strokes(text, "pot.strokes.json");
  return script ? "accepted" : script.error().message;
}

TEST(StrokeFile, ReadsEveryField) {
  const auto script = parse_strokes(
      R"({"seed": 5, "rate_hz": 500, "tremor_mm": 0.1, "travel_mm_s": 250, "start_mm": [90, 120],
          "strokes": [{"through_mm": [[1, 2], [3, 4]], "speed_mm_s": 30, "passes": 2,
                       "step_mm": [0, -1], "hold_s": 0.5, "trim": true, "gap_mm": 4.5},
                      {"through_mm": [[5, 6], [7, 8]]},
                      {"through_mm": [[5, 6], [7, 8]], "gap_mm": [9, 3]},
                      {"kind": "shape", "outline": [[40, 0.9], [30, 0.1]], "inside": true},
                      {"kind": "pull", "outline_mm": [[40, 10], [30, 90]], "gap_mm": [6, 5],
                       "from_mm": 15, "ease_mm": 20},
                      {"kind": "lip"}]})",
      "pot.strokes.json");
  ASSERT_TRUE(script) << script.error().message;
  EXPECT_EQ(script->seed, 5u);
  EXPECT_EQ(script->rate_hz, 500.0);
  EXPECT_EQ(script->tremor_mm, 0.1);
  EXPECT_EQ(script->travel_mm_s, 250.0);
  EXPECT_EQ(script->start_mm, glm::dvec2(90.0, 120.0));
  ASSERT_EQ(script->strokes.size(), 6u);
  const Stroke& stroke = script->strokes[0];
  EXPECT_EQ(stroke.through_mm, (std::vector<glm::dvec2>{{1.0, 2.0}, {3.0, 4.0}}));
  EXPECT_EQ(stroke.speed_mm_s, 30.0);
  EXPECT_EQ(stroke.passes, 2);
  EXPECT_EQ(stroke.step_mm, glm::dvec2(0.0, -1.0));
  EXPECT_EQ(stroke.hold_s, 0.5);
  EXPECT_TRUE(stroke.trim);
  EXPECT_EQ(stroke.gap_mm, std::vector<double>{4.5});
  EXPECT_EQ(script->strokes[1].passes, 1);
  EXPECT_TRUE(script->strokes[1].gap_mm.empty());
  EXPECT_EQ(script->strokes[2].gap_mm, (std::vector<double>{9.0, 3.0}));
  EXPECT_EQ(script->strokes[2].kind, StrokeKind::path);
  const Stroke& shape = script->strokes[3];
  EXPECT_EQ(shape.kind, StrokeKind::shape);
  EXPECT_EQ(shape.outline, (std::vector<glm::dvec2>{{40.0, 0.9}, {30.0, 0.1}}));
  EXPECT_FALSE(shape.outline_in_mm);
  EXPECT_TRUE(shape.inside);
  const Stroke& pull = script->strokes[4];
  EXPECT_EQ(pull.kind, StrokeKind::pull);
  EXPECT_TRUE(pull.outline_in_mm);
  EXPECT_EQ(pull.gap_mm, (std::vector<double>{6.0, 5.0}));
  EXPECT_EQ(pull.from_mm, 15.0);
  EXPECT_EQ(pull.ease_mm, 20.0);
  EXPECT_EQ(script->strokes[5].kind, StrokeKind::lip);
}

TEST(StrokeFile, ErrorsNameLineFieldAndPlace) {
  const auto with = [](const std::string& stroke) {
    const std::string message =
        message_of(R"({"start_mm": [9, 9], "strokes": [{"through_mm": [[1, 2], [3, 4]]},)" +
                   ("\n" + stroke) + "]}");
    const std::string line = "pot.strokes.json:2: ";
    return message.starts_with(line) ? message.substr(line.size()) : message;
  };
  EXPECT_EQ(with(R"({"through_mm": [[1, 2], [3, 4]], "speed_mm_s": "fast"})"),
            R"(strokes[1].speed_mm_s: expected a number from 1 to 10000, found "fast")");
  EXPECT_EQ(with(R"({"through_mm": [[1, 2], [3, 4]], "hold_s": 61})"),
            "strokes[1].hold_s: expected a number from 0 to 60, found 61");
  EXPECT_EQ(with(R"({"through_mm": []})"),
            "strokes[1].through_mm: expected an array of 2 to 100000 points, found an array of 0");
  EXPECT_EQ(with(R"({"speed_mm_s": 3})"),
            R"(strokes[1]: expected a field "through_mm", found none)");
  EXPECT_EQ(with(R"({"through_mm": [[1, 2], [3, null]]})"),
            "strokes[1].through_mm[1][1]: expected a number from -1000 to 1000, found null");
  EXPECT_EQ(with(R"({"through_mm": [[1, 2], [3]]})"),
            "strokes[1].through_mm[1]: expected an array of 2 numbers, found an array of 1");
  EXPECT_EQ(with(R"({"through_mm": [[1, 2], [1, 2]]})"),
            "strokes[1].through_mm[1]: expected a point apart from the one before it, found the "
            "same one");
  EXPECT_EQ(with(R"({"through_mm": [[1, 2], [3, 4]], "passes": 0})"),
            "strokes[1].passes: expected an integer from 1 to 100, found 0");
  EXPECT_EQ(with(R"({"through_mm": [[1, 2], [3, 4]], "passes": -1})"),
            "strokes[1].passes: expected an integer from 1 to 100, found -1");
  EXPECT_EQ(with(R"({"through_mm": [[1, 2], [3, 4]], "trim": 1})"),
            "strokes[1].trim: expected true or false, found 1");
  EXPECT_EQ(with(R"({"through_mm": [[1, 2], [3, 4]], "gap_mm": [5, -1]})"),
            "strokes[1].gap_mm[1]: expected a number from 0 to 1000, found -1");
  EXPECT_EQ(with(R"({"through_mm": [[1, 2], [3, 4], [5, 6]], "gap_mm": [5, 1]})"),
            "strokes[1].gap_mm: expected a number or an array of 3, as many as through_mm, found "
            "an array of 2");
  EXPECT_EQ(with(R"({"kind": "press"})"),
            R"(strokes[1].kind: expected one of path, shape, pull, lip, found "press")");
  EXPECT_EQ(with(R"({"kind": "shape"})"), R"(strokes[1]: expected a field "outline", found none)");
  EXPECT_EQ(with(R"({"kind": "shape", "outline": [[4, 0], [4, 1]],
                     "outline_mm": [[4, 0], [4, 1]]})"),
            "pot.strokes.json:3: strokes[1].outline_mm: expected no outline beside it, found an "
            "array of 2");
  EXPECT_EQ(with(R"({"kind": "pull", "outline": [[4, 0], [4, 1]], "gap_mm": 5})"),
            R"(strokes[1]: expected a field "from_mm", found none)");
  EXPECT_EQ(with(R"({"kind": "shape", "outline_mm": [[4, 1], [5, 3], [6, 3]]})"),
            "strokes[1].outline_mm[2]: expected a height above 3, because heights ascend or "
            "descend, found 3");
  EXPECT_EQ(with(R"({"kind": "shape", "outline_mm": [[4, 3], [5, 1], [6, 2]]})"),
            "strokes[1].outline_mm[2]: expected a height below 1, because heights ascend or "
            "descend, found 2");
  EXPECT_EQ(
      with(R"({"kind": "pull", "outline": [[4, 0], [4, 1]], "gap_mm": [5, 4, 3], "from_mm": 9})"),
      "strokes[1].gap_mm: expected a number or an array of 2, found an array of 3");
  EXPECT_EQ(with("7"), "strokes[1]: expected an object, found 7");
}

/// A pull needs the gap at the wheel and at the rim.
TEST(StrokeFile, RefusesAPullWithoutAnyGap) {
  EXPECT_EQ(message_of(R"({"start_mm": [9, 9], "strokes": [{"kind": "pull", "from_mm": 5,
                           "outline": [[4, 0], [4, 1]], "gap_mm": []}]})"),
            "pot.strokes.json:2: strokes[0].gap_mm: expected a number, or an array of one at "
            "least, found an array of 0");
}

TEST(StrokeFile, RefusesFieldsOfOtherKinds) {
  const auto with = [](const std::string& kind, const std::string& field) {
    return message_of(R"({"start_mm": [9, 9], "strokes": [{"kind": )" + kind + ", " + field +
                      "}]}");
  };
  const std::string path = R"("path", "through_mm": [[1, 2], [3, 4]])";
  const std::string shape = R"("shape", "outline": [[4, 0], [4, 1]])";
  const std::string pull = R"("pull", "outline": [[4, 0], [4, 1]], "gap_mm": 5, "from_mm": 5)";
  for (const auto& [kind, field, name] : {std::tuple(path, R"("inside": true)", "inside"),
                                          {path, R"("from_mm": 5)", "from_mm"},
                                          {shape, R"("step_mm": [1, 1])", "step_mm"},
                                          {shape, R"("gap_mm": 5)", "gap_mm"},
                                          {pull, R"("through_mm": [[1, 2], [3, 4]])", "through_mm"},
                                          {std::string(R"("lip")"), R"("gap_mm": 5)", "gap_mm"}})
    EXPECT_TRUE(with(kind, field)
                    .starts_with("pot.strokes.json:1: unknown field \"" + std::string(name) +
                                 "\" in strokes[0]"))
        << with(kind, field);
}

TEST(StrokeFile, ReadsEverySeed) {
  const auto with = [](const std::string& seed) {
    return R"({"start_mm": [9, 9], "strokes": [{"kind": "lip"}], "seed": )" + seed + "}";
  };
  EXPECT_EQ(parse_strokes(with("18446744073709551615"), "s")->seed, UINT64_MAX);
  for (const std::string seed : {"-1", "18446744073709551616", "1.0"})
    EXPECT_TRUE(message_of(with(seed))
                    .starts_with("pot.strokes.json:1: seed: expected an integer from 0 to "
                                 "18446744073709551615, found "))
        << message_of(with(seed));
}

TEST(StrokeFile, ReportsErrorsOfTheWholeFile) {
  EXPECT_EQ(message_of("[]"), "pot.strokes.json:1: expected an object, found an array of 0");
  EXPECT_EQ(message_of(R"({"strokes": []})"),
            R"(pot.strokes.json:1: expected a field "start_mm", found none)");
  EXPECT_EQ(message_of(R"({"start_mm": [9, 9], "strokes": []})"),
            "pot.strokes.json:1: strokes: expected one stroke at least, found an array of 0");
  const std::string torn = message_of(R"({"start_mm": [9, 9)");
  EXPECT_TRUE(torn.starts_with("pot.strokes.json:1: ")) << torn;
}

TEST(StrokeFile, RefusesUnknownFields) {
  EXPECT_TRUE(
      message_of(
          R"({"start_mm": [9, 9], "tempo": 1, "strokes": [{"through_mm": [[1, 2], [3, 4]]}]})")
          .starts_with(R"(pot.strokes.json:1: unknown field "tempo"; expected one of )"));
  const std::string near =
      message_of(R"({"start_mm": [9, 9], "strokes": [{"kind": "lip", "speed_mms": 3}]})");
  EXPECT_TRUE(near.ends_with(R"(; did you mean "speed_mm_s"?)")) << near;
  EXPECT_EQ(message_of("{\"seed\": 1,\n\"seed\": 2}"),
            "pot.strokes.json:2: duplicate field \"seed\"");
  EXPECT_EQ(message_of(std::string(100'000, '[')),
            "pot.strokes.json:1: expected at most 64 levels, found more");
  const std::string long_name(500'000, 'x');
  EXPECT_LT(message_of("{\"" + long_name +
                       "\": 1, \"start_mm\": [9, 9], "
                       "\"strokes\": [{\"through_mm\": [[1, 2], [3, 4]]}]}")
                .size(),
            400u);
  EXPECT_LT(
      message_of("{\"start_mm\": \"" + std::string(500'000, 'x') + "\", \"strokes\": []}").size(),
      300u);
}

/// 20 passes of 60 s at 10 kHz are 12 million poses, plus those between passes.
TEST(StrokeFile, RefusesMorePosesThanASessionHolds) {
  const auto held = [](int passes) {
    return message_of(R"({"start_mm": [9, 9], "rate_hz": 10000, "strokes": [{"hold_s": 60,
                          "through_mm": [[1, 2], [3, 4]], "passes": )" +
                      std::to_string(passes) + "}]}");
  };
  EXPECT_EQ(held(16), "accepted");
  EXPECT_EQ(held(20).rfind("pot.strokes.json:1: strokes: expected at most 10000000 poses in a "
                           "session, found about 120",
                           0),
            0u)
      << held(20);
}

}  // namespace
}  // namespace clay::strokes
