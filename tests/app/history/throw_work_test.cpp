#include "claystack/engine/files.hpp"
#include "tests/app/history/strokes.hpp"
#include "tests/support/run_program.hpp"

#include <gtest/gtest.h>

#include <array>
#include <string>
#include <vector>

namespace clay::history {
namespace {

using test::claystack;
using test::press_stroke;
using test::read_text;
using test::small_scene;

TEST(ThrowWork, ReproducesTheThrownPotByteForByte) {
  const test::ScratchFolder folder;
  const std::string path = folder.file("mine.work"), pot = folder.file("p.pot.json");
  Work work = Work::begin(small_scene()).value();
  (void)work.add(small_scene(), press_stroke(1)).value();
  (void)work.add(small_scene(5.0), press_stroke(2)).value();
  work.undo();
  ASSERT_TRUE(work.save(path));
  for (const auto& [node, option] : {std::pair(1u, ""), {2u, " --at 2"}, {0u, " --at 0"}}) {
    const auto run = claystack("throw " + path + option + " -o " + pot);
    ASSERT_EQ(run.status, 0) << run.err;
    const SceneSpec scene = small_scene(node == 2 ? 5.0 : 8.0);
    EXPECT_EQ(read_text(pot), write_pot(**work.pot(node), PotEncoding::json));
  }
  const auto list = claystack("throw " + path + " --list --json").json();
  ASSERT_EQ(list["nodes"].size(), 3u);
  EXPECT_EQ(list["node"], 1);
  EXPECT_EQ(list["nodes"][2]["parent"], 1);
  EXPECT_EQ(list["nodes"][2]["tool"], "press sphere");
  EXPECT_TRUE(list["nodes"][1]["current"]);
  EXPECT_NE(claystack("throw " + path + " --list").out.find("* 1 below 0: press sphere, 0.18 s"),
            std::string::npos);
}

TEST(ThrowWork, ListsStrokesOfEveryMode) {
  const test::ScratchFolder folder;
  const std::string path = folder.file("mine.work");
  constexpr std::array kModes = {ToolMode::press,    ToolMode::trim,   ToolMode::pinch,
                                 ToolMode::smooth,   ToolMode::needle, ToolMode::wire,
                                 ToolMode::trim_foot};
  Work work = Work::begin(small_scene()).value();
  for (const ToolMode mode : kModes) {
    SceneSpec scene = small_scene(8.0, mode);
    if (mode == ToolMode::pinch) scene.tool.gap_mm = 4.0;
    if (mode == ToolMode::smooth) scene.clay = ClaySpec{};
    (void)work.add(scene, press_stroke(1)).value();
  }
  ASSERT_TRUE(work.save(path));
  const auto nodes = claystack("throw " + path + " --list --json").json().at("nodes");
  ASSERT_EQ(nodes.size(), kModes.size() + 1);
  std::vector<std::string> tools;
  for (std::size_t node = 1; node < nodes.size(); ++node) tools.push_back(nodes[node].at("tool"));
  EXPECT_EQ(tools, (std::vector<std::string>{"press sphere", "trim sphere", "pinch sphere",
                                             "smooth sphere", "needle sphere", "wire sphere",
                                             "trim_foot sphere"}));
}

TEST(ThrowWork, RefusesOptionsInvalidForAWork) {
  const test::ScratchFolder folder;
  const std::string path = folder.file("mine.work");
  ASSERT_TRUE(Work::begin(small_scene()).value().save(path));
  const auto refused = [&](const std::string& arguments, const std::string& message, int status) {
    const auto run = claystack("throw " + arguments);
    EXPECT_EQ(run.status, status) << arguments;
    EXPECT_NE(run.err.find(message), std::string::npos) << run.err;
  };
  refused(path + " --at 1", "--at: expected a node of " + path + ", from 0 to 0, found 1", 2);
  refused(path + " -s x.session", "expected only --at, --list and -o", 2);
  refused(test::sample("bowl.scene.json") + " --list", "--at and --list: expected NAME.work", 2);
  refused(folder.file("none.work"), "none.work: ", 3);
  test::write_text(path, read_text(path) + "{\"at\":7,\"check\":\"0123456789abcdef\"}\n");
  refused(path, path + ":4: at: expected a node below 1, found 7", 2);
}

TEST(ThrowFrom, ContinuesAPot) {
  const test::ScratchFolder folder;
  const auto file = [&](const char* name) { return folder.file(name); };
  const SceneSpec scene = small_scene();
  test::write_text(file("a.scene.json"), write_scene(scene));
  const auto record = [&](const char* name, std::uint64_t seed) {
    test::write_text(file(name),
                     write_session({"small", hash_of(scene), press_stroke(seed), false}));
  };
  record("1.session", 1);
  record("2.session", 2);
  const std::string first = "throw " + file("a.scene.json") + " -s " + file("1.session");
  const std::string second = "throw " + file("a.scene.json") + " -s " + file("2.session");
  ASSERT_EQ(claystack(first + " -o " + file("1.pot.cbor")).status, 0);
  const auto run =
      claystack(second + " --from " + file("1.pot.cbor") + " -o " + file("2.pot.json"));
  ASSERT_EQ(run.status, 0) << run.err;
  Work work = Work::begin(scene).value();
  (void)work.add(scene, press_stroke(1)).value();
  (void)work.add(scene, press_stroke(2)).value();
  EXPECT_EQ(read_text(file("2.pot.json")), write_pot(**work.pot(), PotEncoding::json));

  const auto model = claystack(second + " --model paper --from " + file("1.pot.cbor"));
  EXPECT_EQ(model.status, 2);
  EXPECT_NE(model.err.find(file("a.scene.json") + " on " + file("1.pot.cbor") +
                           ": model: expected the pot's, conserving, found paper"),
            std::string::npos)
      << model.err;
  const auto same =
      claystack(second + " --from " + file("1.pot.cbor") + " -o " + file("1.pot.cbor"));
  EXPECT_EQ(same.status, 2);
}

#ifdef CLAYSTACK_FALCON
TEST(ThrowFrom, ContinuesAPotByHand) {
  const test::ScratchFolder folder;
  const std::string scene = test::sample("cylinder.scene.json");
  const auto pot = folder.file("1.pot.json"), live = folder.file("live.pot.json"),
             again = folder.file("again.pot.json"), session = folder.file("live.session");
  ASSERT_EQ(claystack("throw " + scene + " -o " + pot).status, 0);
  const auto run = claystack("throw " + scene + " --from " + pot +
                             " --device simulated --seconds 3 --record " + session + " -o " + live);
  ASSERT_EQ(run.status, 0) << run.err;
  ASSERT_EQ(
      claystack("throw " + scene + " --from " + pot + " -s " + session + " -o " + again).status, 0);
  EXPECT_EQ(read_text(live), read_text(again));
}
#endif

}  // namespace
}  // namespace clay::history
