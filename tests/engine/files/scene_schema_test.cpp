#include "claystack/core/atomic_file.hpp"
#include "claystack/engine/files.hpp"
#include "tests/engine/files/arbitrary.hpp"
#include "tests/engine/files/full_scene.hpp"
#include "tests/support/schema_check.hpp"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <algorithm>
#include <array>
#include <filesystem>
#include <set>
#include <string>

namespace clay {
namespace {

using test::Json;

RC_GTEST_PROP(SceneSchema, AcceptsWrittenScenes, ()) {
  static const Json schema = test::load_schema("scene");
  const std::string text = write_scene(test::arbitrary_scene());
  RC_ASSERT(test::violation(schema, Json::parse(text)) == "");
}

TEST(SceneSchema, NamesTheWrittenFields) {
  std::set<std::string> written;
  for (const ToolShapeSpec& shape :
       {ToolShapeSpec(SphereSpec{}), ToolShapeSpec(EllipseSpec{}), ToolShapeSpec(RibSpec{}),
        ToolShapeSpec(SampledSpec{{0, 1}, {1, 1}})}) {
    SceneSpec scene = test::full_scene();
    scene.tool.shape = shape;
    const auto paths = test::member_paths(Json::parse(write_scene(scene)));
    written.insert(paths.begin(), paths.end());
  }
  const auto described = test::property_paths(test::load_schema("scene"));
  EXPECT_EQ(written, std::set<std::string>(described.begin(), described.end()));
}

/// A schema cannot compare two fields, so the reader is stricter there.
bool is_scene_rule(const std::string& message) {
  constexpr std::array kRules = {"less than outer_radius_mm", "at least rings", "more than",
                                 "as many numbers as"};
  return std::ranges::any_of(
      kRules, [&](const char* rule) { return message.find(rule) != std::string::npos; });
}

TEST(SceneSchema, AgreesWithTheReader) {
  const Json schema = test::load_schema("scene");
  for (const ToolShapeSpec& shape :
       {ToolShapeSpec(SphereSpec{}), ToolShapeSpec(EllipseSpec{}), ToolShapeSpec(RibSpec{}),
        ToolShapeSpec(SampledSpec{{0, 1}, {1, 1}})}) {
    SceneSpec scene = test::full_scene();
    scene.tool.shape = shape;
    for (const auto& [what, file] : test::edits(schema, Json::parse(write_scene(scene)))) {
      const auto read = parse_scene(file.dump(), "edited");
      if (!read && is_scene_rule(read.error().message)) continue;
      EXPECT_EQ(read.has_value(), test::violation(schema, file).empty())
          << what << ": " << (read ? "read" : read.error().message);
    }
  }
}

TEST(SceneSchema, AcceptsEverySample) {
  const Json schema = test::load_schema("scene");
  int samples = 0;
  for (const auto& entry : std::filesystem::directory_iterator(CLAYSTACK_SAMPLES)) {
    const std::string name = entry.path().filename().string();
    if (!name.ends_with(".scene.json")) continue;
    const std::string text = read_file(entry.path()).value();
    const auto read = parse_scene(text, name);
    EXPECT_TRUE(read) << read.error().message;
    EXPECT_EQ(test::violation(schema, Json::parse(text)), "") << name;
    ++samples;
  }
  EXPECT_GT(samples, 0);
}

TEST(SceneSchema, StatesTheDefaultsOfTheReader) {
  // A file that states all defaults must be the same scene as a file without them.
  const auto filled = [](const auto& self, const Json& schema) -> Json {
    if (schema.contains("default") && !schema["default"].is_object()) return schema["default"];
    Json object = Json::object();
    for (const auto& [name, member] : schema["properties"].items())
      if (member.contains("default") || member.contains("properties"))
        object[name] = self(self, member);
    return object;
  };
  Json file = filled(filled, test::load_schema("scene"));
  file["schema"] = "claystack-scene-1";
  for (const char* shape : {"sphere", "ellipse", "rib"}) {
    const Json only = file["tool"]["shape"][shape];
    Json one = file;
    one["tool"]["shape"] = {{shape, only}};
    Json bare = {{"schema", "claystack-scene-1"},
                 {"lump", Json::object()},
                 {"tool", {{"shape", {{shape, Json::object()}}}}},
                 {"force", Json::object()},
                 {"stability", Json::object()},
                 {"clay", Json::object()}};
    EXPECT_EQ(parse_scene(one.dump(), "full").value(), parse_scene(bare.dump(), "bare").value());
  }
}

}  // namespace
}  // namespace clay
