#include "app/strokes/strokes.hpp"

#include <gtest/gtest.h>

#include <string>
#include <string_view>
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

TEST(StrokeFile, ErrorsNameFieldAndPlace) {
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
  EXPECT_EQ(with(R"({"through_mm": [[1, 2], [3, 4]], "gap_mm": [5, -1]})"),
            "pot.strokes.json: strokes[1].gap_mm[1]: expected a number from 0.0 to 1000.0, found "
            "-1");
  EXPECT_EQ(with(R"({"through_mm": [[1, 2], [3, 4], [5, 6]], "gap_mm": [5, 1]})"),
            "pot.strokes.json: strokes[1].gap_mm: expected a number or an array of 3, as many as "
            "through_mm, found an array of 2");
  EXPECT_EQ(
      with(R"({"kind": "press"})"),
      R"(pot.strokes.json: strokes[1].kind: expected path, shape, pull or lip, found "press")");
  EXPECT_EQ(with(R"({"kind": "shape"})"),
            "pot.strokes.json: strokes[1].outline: expected a field, found none");
  EXPECT_EQ(with(R"({"kind": "pull", "outline": [[4, 0], [4, 1]], "gap_mm": 5})"),
            "pot.strokes.json: strokes[1].from_mm: expected a field, found none");
  EXPECT_EQ(with(R"({"kind": "shape", "outline_mm": [[4, 1], [5, 3], [6, 3]]})"),
            "pot.strokes.json: strokes[1].outline_mm: expected heights in strictly ascending or "
            "descending order, found 3.0 before 3.0");
  EXPECT_EQ(with(R"({"kind": "pull", "outline": [[4, 0], [4, 1]], "gap_mm": [5, 4, 3],
                     "from_mm": 9})"),
            "pot.strokes.json: strokes[1].gap_mm: expected a number or an array of 2, found an "
            "array of 3");
  EXPECT_EQ(with("7"), "pot.strokes.json: strokes[1]: expected an object, found 7");
}

TEST(StrokeFile, ReportsErrorsOfTheWholeFile) {
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
  EXPECT_TRUE(torn.starts_with("pot.strokes.json:1: ")) << torn;
}

TEST(StrokeFile, RefusesUnknownFields) {
  EXPECT_EQ(message_of("{\"seed\": 1,\n\"seed\": 2}"),
            "pot.strokes.json:2: duplicate field \"seed\"");
  EXPECT_EQ(message_of(std::string(100'000, '[')),
            "pot.strokes.json:1: expected at most 64 levels, found more");
  const std::string long_name(500'000, 'x');
  EXPECT_LT(message_of("{\"" + long_name +
                       "\": 1, \"start_mm\": [9, 9], "
                       "\"strokes\": [{\"through_mm\": [[1, 2], [3, 4]]}]}")
                .size(),
            300u);
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
  EXPECT_EQ(held(20).rfind("pot.strokes.json: strokes: expected at most 10000000 poses in a "
                           "session, found about 120",
                           0),
            0u)
      << held(20);
}

}  // namespace
}  // namespace clay::strokes
