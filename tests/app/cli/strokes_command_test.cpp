// claystack strokes, run as a program.

#include "claystack/engine/files.hpp"
#include "tests/support/run_program.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <string>

namespace clay::strokes {
namespace {

using test::claystack;
using test::read_text;
using test::sample;
using test::ScratchFolder;

std::string strokes(const std::string& script, const std::string& session) {
  return "strokes " + sample("cylinder.scene.json") + " " + script + " -o " + session;
}

TEST(StrokesCommand, MakesTheSampleSessionAgain) {
  const ScratchFolder folder;
  const auto made = claystack(
      strokes(sample("strokes/cylinder.strokes.json"), folder.file("c.session")) + " --json");
  ASSERT_EQ(made.status, 0) << made.err;
  const std::string text = read_text(folder.file("c.session"));
  EXPECT_EQ(text, read_text(sample("cylinder.session")));
  EXPECT_EQ(made.json().at("poses").get<std::size_t>(), parse_session(text, "c")->poses.size());
}

TEST(StrokesCommand, PrintsTheSecondsOfWholeMicroseconds) {
  const ScratchFolder folder;
  const auto made =
      claystack("strokes --json " + sample("bottle.scene.json") + " " +
                sample("strokes/bottle.strokes.json") + " -o " + folder.file("b.session"));
  ASSERT_EQ(made.status, 0) << made.err;
  const std::string seconds = made.json().at("seconds").dump();
  EXPECT_LE(seconds.size(), std::string("100.000001").size()) << seconds;
}

TEST(StrokesCommand, NamesTheFileAndThePlaceOfAFault) {
  const ScratchFolder folder;
  test::write_text(folder.file("s.strokes.json"),
                   R"({"start_mm": [80, 100], "strokes": [{"kind": "pull"}]})");
  const auto refused = claystack(strokes(folder.file("s.strokes.json"), folder.file("c.session")));
  EXPECT_EQ(refused.status, 2);
  EXPECT_NE(refused.err.find("s.strokes.json:1: strokes[0]: expected a field \"outline\""),
            std::string::npos)
      << refused.err;
  EXPECT_FALSE(std::filesystem::exists(folder.file("c.session")));
  EXPECT_EQ(claystack(strokes(folder.file("none"), folder.file("c.session"))).status, 3);
  EXPECT_EQ(claystack(strokes(folder.file("s.strokes.json"), folder.file("c.stl"))).status, 2);
}

TEST(StrokesCommand, NamesTheFileThatTheWheelRefuses) {
  const ScratchFolder folder;
  std::string scene = read_text(sample("cylinder.scene.json"));
  const auto gap = scene.find("\"gap_mm\"");
  ASSERT_NE(gap, std::string::npos);
  const auto comma = scene.rfind(',', gap);
  scene.erase(comma, scene.find_first_of(",\n", gap) - comma);  // a scene of one tool
  test::write_text(folder.file("one.scene.json"), scene);
  test::write_text(folder.file("two.strokes.json"),
                   R"({"start_mm": [80, 100], "strokes": [{"through_mm": [[60, 9], [50, 9]]},
                       {"through_mm": [[60, 9], [50, 9]], "gap_mm": 4}]})");
  const auto refused =
      claystack("strokes " + folder.file("one.scene.json") + " " + folder.file("two.strokes.json") +
                " -o " + folder.file("c.session"));
  EXPECT_EQ(refused.status, 2);
  EXPECT_NE(refused.err.find("two.strokes.json: strokes[1].gap_mm: expected one tool, because the "
                             "scene sets no tool.gap_mm"),
            std::string::npos)
      << refused.err;
  EXPECT_FALSE(std::filesystem::exists(folder.file("c.session")));
}

/// A stroke of kind lip goes to the rim of the pot that it is planned on.
double nearest_to_axis_mm(const std::string& session) {
  double nearest = 1e9;
  const Session played = parse_session(read_text(session), session).value();
  for (const Pose& pose : played.poses) nearest = std::min(nearest, pose.position_mm.x);
  return nearest;
}

TEST(StrokesCommand, StartsFromAPot) {
  const ScratchFolder folder;
  const std::string pot = folder.file("b.pot.json"), script = folder.file("lip.strokes.json");
  const std::string lump = folder.file("lump.session"), lip = folder.file("lip.session");
  test::write_text(script, R"({"start_mm": [150, 150], "tremor_mm": 0, "rate_hz": 250,
                               "strokes": [{"kind": "lip"}]})");
  ASSERT_EQ(claystack("throw " + sample("bowl.scene.json") + " -o " + pot).status, 0);
  ASSERT_EQ(claystack("strokes " + sample("bowl.scene.json") + " " + script + " -o " + lump).status,
            0);
  for (const std::string& scene : {sample("bowl.scene.json") + " ", std::string()}) {
    const auto made = claystack("strokes " + scene + script + " --from " + pot + " -o " + lip);
    ASSERT_EQ(made.status, 0) << made.err;
    constexpr double kToolMm = 10.0;  // larger than that of the scene
    const double rim_mm = parse_pot(read_text(pot), pot)->stack.rings().back().inner_mm();
    EXPECT_GT(nearest_to_axis_mm(lip), rim_mm - 2.0 * kToolMm);
    EXPECT_LT(nearest_to_axis_mm(lump), rim_mm - 2.0 * kToolMm);
    // Played on that pot, the session causes no warning.
    const auto thrown = claystack("throw -q " + scene + "--from " + pot + " -s " + lip);
    EXPECT_EQ(thrown.status, 0);
    EXPECT_EQ(thrown.err, "");
  }
}

TEST(StrokesCommand, NamesTheMissingArgument) {
  const struct {
    const char* arguments;
    const char* message;
  } cases[] = {{"strokes -o s.session",
                "expected scene (NAME.scene.json, or - for standard input), found none"},
               {"strokes a.scene.json -o s.session", "expected script (NAME.strokes.json)"},
               {"strokes --from a.pot.json -o s.session", "expected script (NAME.strokes.json)"}};
  for (const auto& [arguments, message] : cases) {
    const auto refused = claystack(arguments);
    EXPECT_EQ(refused.status, 2);
    EXPECT_NE(refused.err.find(message), std::string::npos) << refused.err;
  }
}

}  // namespace
}  // namespace clay::strokes
