// The window with real events on a virtual screen.

#include "tests/support/run_program.hpp"

#include <gtest/gtest.h>

#include <string>

namespace clay::studio {
namespace {

using test::claystack;
using test::Ran;
using test::read_text;
using test::ScratchFolder;
using test::shell;

class OnScreen : public ::testing::Test {
 protected:
  void SetUp() override {
    ASSERT_EQ(shell("command -v Xvfb && command -v xdotool").status, 0)
        << "needs Xvfb and xdotool (tests/run.sh installs them)";
  }
  Ran run(const char* script, const ScratchFolder& folder) {
    return shell(std::string("sh ") + CLAYSTACK_STUDIO_TESTS + "/" + script +
                 " " CLAYSTACK_PROGRAM " " + folder.path().string());
  }
};

TEST_F(OnScreen, WorksFromTheGalleryToAPrintableFile) {
  const ScratchFolder folder;
  const Ran ran = run("under_xvfb.sh", folder);
  ASSERT_EQ(ran.status, 0) << ran.err << ran.out;
  const auto kept = nlohmann::json::parse(read_text(folder.file("config/claystack/studio.json")));
  EXPECT_NEAR(kept.at("scale"), 1.1, 1e-6) << "one step larger";
  EXPECT_EQ(claystack("check " + folder.file("bowl.3mf")).status, 0);
  const std::string info = shell("prusa-slicer --info " + folder.file("bowl.3mf")).out;
  EXPECT_NE(info.find("manifold = yes"), std::string::npos) << info;
}

TEST_F(OnScreen, KeysAreThoseOfTheUsersLayout) {
  const ScratchFolder folder;
  const Ran ran = run("layout_under_xvfb.sh", folder);
  ASSERT_EQ(ran.status, 0) << ran.err << ran.out;
  const auto count = [&](const std::string& line) {
    std::size_t found = 0;
    for (std::size_t at = 0; (at = ran.out.find(line, at)) != std::string::npos; ++at) ++found;
    return found;
  };
  EXPECT_EQ(count("action: edit.undo"), 1u) << ran.out;
  EXPECT_EQ(count("action: edit.redo"), 1u) << ran.out;
}

TEST_F(OnScreen, OffersAnUnrecoveredWorkUntilItIsDiscarded) {
  const ScratchFolder folder;
  test::write_text(folder.file("lump.scene.json"), read_text(test::sample("vase.scene.json")));
  const Ran ran = run("declined_under_xvfb.sh", folder);
  EXPECT_EQ(ran.status, 0) << ran.err << ran.out;
}

/// The tests of the journal bound the lost part of the stroke.
TEST_F(OnScreen, OffersTheJournalOfAKilledWindow) {
  const ScratchFolder folder;
  const Ran ran = run("killed_under_xvfb.sh", folder);
  ASSERT_EQ(ran.status, 0) << ran.err << ran.out;
  const Ran before = claystack("throw " + folder.file("before.work") + " --list --json");
  ASSERT_EQ(before.status, 0) << before.err;
  const auto nodes = nlohmann::json::parse(read_text(folder.file("tree.json"))).at("nodes");
  ASSERT_EQ(nodes.size(), 3u) << nodes;
  EXPECT_EQ(nodes[2].at("parent"), 1);
  EXPECT_GT(nodes[2].at("seconds"), 0.0);
  EXPECT_GE(nodes[2].at("seconds"), before.json().at("nodes").at(2).at("seconds"));
}

}  // namespace
}  // namespace clay::studio
