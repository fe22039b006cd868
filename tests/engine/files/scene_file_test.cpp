#include "claystack/engine/files.hpp"

#include "tests/engine/files/arbitrary.hpp"
#include "tests/engine/files/full_scene.hpp"
#include "tests/engine/files/text_edits.hpp"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <string>
#include <string_view>

namespace clay {
namespace {

constexpr std::string_view kText = R"({
  "schema": "claystack-scene-1",
  "written_by": "a hand",
  "name": "vase",
  "model": "paper",
  "lump": {
    "rings": 300,
    "ring_height_mm": 0.5,
    "outer_radius_mm": 40,
    "inner_radius_mm": 35.5,
    "max_rings": 900,
    "density_g_cm3": 2.1
  },
  "tool": {
    "shape": {
      "sampled": {
        "t_mm": [-2, 0,
                 2.5],
        "f_mm": [1, 2, 0]
      }
    },
    "mode": "trim",
    "gap_mm": 4.5
  },
  "removal": {"rate_per_s": 7, "yield_depth_mm": 0.5, "min_wall_mm": 2, "paper_fraction": 0.25},
  "flow": {"sigma_mm": 3, "reach_mm": 12, "inside_share": 0.5},
  "force": {
    "stiffness_n_per_mm2": 0.1,
    "limit_n": 4,
    "friction": 0.3,
    "wheel": "clockwise",
    "paper_stiffness_n_per_mm": 0.75
  },
  "stability": {"max_stress_kpa": 8},
  "clay": {
    "lift": "off",
    "shift": "off",
    "rim": "off",
    "hoop": "off",
    "heave": "off",
    "smear": "off",
    "wheel_rpm": 90,
    "floor_mm": 7,
    "finger_mm": 80,
    "finger_behind": 0.75,
    "heave_slope": 0.3,
    "thin_wall": "yields",
    "pressed_rim": "sinks",
    "narrow_rim": "closes",
    "lifted_wall": "stretches",
    "pushed_wall": "bends",
    "sponge": "follows",
    "pressed_lump": "stretches",
    "thin_rim": "rises"
  }
}
)";

/// Replaces `from` by `to`; the message must name the line of `from`.
void expect_scene_error(std::string_view from, std::string_view to, const std::string& message) {
  SCOPED_TRACE(to);
  test::expect_refused(
      parse_scene(test::replaced(std::string(kText), from, to), "vase.scene.json"),
      "vase.scene.json:" + std::to_string(test::line_of(kText, from)) + ": " + message);
}

TEST(SceneFile, ReadsEveryField) {
  const auto scene = parse_scene(kText, "vase.scene.json");
  ASSERT_TRUE(scene) << scene.error().message;
  EXPECT_EQ(*scene, test::full_scene());
}

TEST(SceneFile, UsesDefaultsForAbsentFields) {
  const auto scene =
      parse_scene(R"({"schema": "claystack-scene-1", "lump": {}, "tool": {}})", "least");
  ASSERT_TRUE(scene) << scene.error().message;
  EXPECT_EQ(scene->name, "");
  EXPECT_EQ(scene->model, Model::conserving);
  EXPECT_EQ(scene->lump, LumpSpec{});
  EXPECT_EQ(scene->tool, ToolSpec{});
  EXPECT_EQ(scene->flow, FlowSpec{});
  EXPECT_EQ(scene->removal.rate_per_s, RemovalSpec{}.rate_per_s);
  EXPECT_EQ(scene->removal.yield_depth_mm, RemovalSpec{}.yield_depth_mm);
  EXPECT_EQ(scene->removal.min_wall_mm, RemovalSpec{}.min_wall_mm);
  EXPECT_FALSE(scene->removal.paper_fraction);
  EXPECT_FALSE(scene->force);
  EXPECT_FALSE(scene->stability);
}

TEST(SceneFile, ReadsEveryToolShape) {
  const auto shape = [](const std::string& text) {
    return parse_scene(
               R"({"schema": "claystack-scene-1", "lump": {}, "tool": {"shape": )" + text + "}}",
               "shape")
        .value()
        .tool.shape;
  };
  EXPECT_EQ(shape(R"({"sphere": {"radius_mm": 3}})"), ToolShapeSpec(SphereSpec{3}));
  EXPECT_EQ(shape(R"({"ellipse": {"half_height_mm": 3, "half_width_mm": 2}})"),
            ToolShapeSpec(EllipseSpec{3, 2}));
  EXPECT_EQ(shape(R"({"rib": {"height_mm": 3, "radius_mm": 2}})"), ToolShapeSpec(RibSpec{3, 2}));
  EXPECT_EQ(shape(R"({"rib": {}})"), ToolShapeSpec(RibSpec{}));
}

TEST(SceneFile, ErrorsNameTheLineOfANumber) {
  expect_scene_error("300", "0", "lump.rings: expected an integer from 1 to 16777216, found 0");
  expect_scene_error("300", "300.5",
                     "lump.rings: expected an integer from 1 to 16777216, found 300.5");
  expect_scene_error(
      "300", "18446744073709551615",
      "lump.rings: expected an integer from 1 to 16777216, found 18446744073709551615");
  expect_scene_error("0.5,", "2000,",
                     "lump.ring_height_mm: expected a number from 0.001 to 1000, found 2000");
  expect_scene_error(
      "35.5", "\"35.5\"",
      "lump.inner_radius_mm: expected a number from 0 to below 5000, found \"35.5\"");
  expect_scene_error("0.25", "1",
                     "removal.paper_fraction: expected a number from 0 to below 1, found 1");
  expect_scene_error("4.5", "0", "tool.gap_mm: expected a number from 0.001 to 1000, found 0");
  expect_scene_error("8}", "0}",
                     "stability.max_stress_kpa: expected a number above 0 to 1e+06, found 0");
  expect_scene_error(
      "2.5]", "[]]",
      "tool.shape.sampled.t_mm[2]: expected a number from -5000 to 5000, found an array "
      "of 0");
}

TEST(SceneFile, ErrorsNameTheLineOfOtherValues) {
  expect_scene_error("\"claystack-scene-1\"", "\"claystack-scene-2\"",
                     "schema: expected \"claystack-scene-1\", found \"claystack-scene-2\"");
  expect_scene_error("\"a hand\"", "1", "written_by: expected a text, found 1");
  expect_scene_error("\"vase\"", "null", "name: expected a text, found null");
  expect_scene_error("\"paper\"", "\"papal\"",
                     "model: expected one of conserving, paper, found \"papal\"");
  expect_scene_error(
      "\"trim\"", "true",
      "tool.mode: expected one of press, trim, pinch, smooth, needle, wire, trim_foot, found true");
  expect_scene_error("{\"sigma_mm\": 3, \"reach_mm\": 12, \"inside_share\": 0.5}", "3",
                     "flow: expected an object, found 3");
  expect_scene_error("[1, 2, 0]", "1", "tool.shape.sampled.f_mm: expected an array, found 1");
}

TEST(SceneFile, ErrorsBetweenFieldsNameTheLineOfOne) {
  expect_scene_error("35.5", "40",
                     "lump.inner_radius_mm: expected less than outer_radius_mm, 40, found 40");
  expect_scene_error("900", "299", "lump.max_rings: expected 0 or at least rings, 300, found 299");
  expect_scene_error("2.5]", "0]", "tool.shape.sampled.t_mm[2]: expected more than 0, found 0");
  expect_scene_error(
      "[1, 2, 0]", "[1, 2]",
      "tool.shape.sampled.f_mm: expected as many numbers as t_mm, 3, found an array of 2");
  test::expect_refused(
      parse_scene(R"({"schema": "claystack-scene-1", "lump": {},
                      "tool": {"shape": {"sampled":
                        {"t_mm": [1], "f_mm": [1]}}}})",
                  "one"),
      "one:3: tool.shape.sampled.t_mm: expected two numbers at least, found an array of 1");
}

TEST(SceneFile, ErrorsNameUnknownFields) {
  expect_scene_error("\"trim\"", "\"trim\", \"colour\": 3",
                     "unknown field \"colour\" in tool; expected one of shape, mode, gap_mm");
  expect_scene_error(
      "\"friction\"", "\"fricton\"",
      "unknown field \"fricton\" in force; expected one of stiffness_n_per_mm2, limit_n, "
      "friction, wheel, paper_stiffness_n_per_mm; did you mean \"friction\"?");
  expect_scene_error(
      "\"limit_n\"", "\"limti_n\"",
      "unknown field \"limti_n\" in force; expected one of stiffness_n_per_mm2, limit_n, "
      "friction, wheel, paper_stiffness_n_per_mm; did you mean \"limit_n\"?");
  expect_scene_error(
      "\"stability\"", "\"colour\"",
      "unknown field \"colour\"; expected one of schema, written_by, name, model, lump, "
      "tool, removal, flow, force, stability, clay");
  expect_scene_error("\"friction\": 0.3", "\"limit_n\": 3", "duplicate field \"limit_n\"");
}

TEST(SceneFile, ErrorsNameMissingFields) {
  expect_scene_error("\"sampled\": {\n        \"t_mm\"", "\"sampled\": {\n        \"tmm\"",
                     "tool.shape.sampled: expected a field \"t_mm\", found \"tmm\"");
  test::expect_refused(parse_scene(R"({"schema": "claystack-scene-1", "lump": {},
                                       "tool": {"mode": "pinch"}})",
                                   "pinch"),
                       "pinch:2: tool: expected a field \"gap_mm\", found none");
  test::expect_refused(parse_scene("{}", "empty"),
                       "empty:1: expected a field \"schema\", found none");
}

TEST(SceneFile, RequiresExactlyOneShape) {
  const auto with_shape = [](const std::string& shape) {
    return parse_scene(
        R"({"schema": "claystack-scene-1", "lump": {}, "tool": {"shape": )" + shape + "}}",
        "shape");
  };
  test::expect_refused(with_shape("{}"),
                       "shape:1: tool.shape: expected exactly one of sphere, ellipse, rib, "
                       "sampled, found an object with 0 fields");
  test::expect_refused(with_shape(R"({"sphere": {}, "rib": {}})"),
                       "shape:1: tool.shape: expected exactly one of sphere, ellipse, rib, "
                       "sampled, found an object with 2 fields");
  test::expect_refused(with_shape(R"({"cube": {}})"),
                       "shape:1: unknown field \"cube\" in tool.shape; expected one of sphere, "
                       "ellipse, rib, sampled");
}

TEST(SceneFile, WritesOneMemberPerLine) {
  SceneSpec scene;
  scene.tool.shape = SampledSpec{{0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10.5}, {1, 1}};
  scene.force.reset();
  const std::string text = write_scene(scene);
  EXPECT_NE(text.find("{\n  \"schema\": \"claystack-scene-1\",\n  \"written_by\": \"claystack "),
            std::string::npos);
  EXPECT_NE(text.find("    \"ring_height_mm\": 0.75,\n    \"outer_radius_mm\": 45,\n"),
            std::string::npos);
  EXPECT_NE(text.find("        \"t_mm\": [\n"
                      "          0, 1, 2, 3, 4, 5, 6, 7, 8, 9,\n"
                      "          10.5\n"
                      "        ],\n"
                      "        \"f_mm\": [1, 1]\n"),
            std::string::npos);
  EXPECT_EQ(text.substr(text.size() - 6), "  }\n}\n");
}

RC_GTEST_PROP(SceneFile, RoundTrips, ()) {
  const SceneSpec scene = test::arbitrary_scene();
  const std::string text = write_scene(scene);
  const auto read = parse_scene(text, "written");
  RC_ASSERT(read.has_value());
  RC_ASSERT(*read == scene);
  RC_ASSERT(write_scene(*read) == text);
}

}  // namespace
}  // namespace clay
