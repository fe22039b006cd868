// The window with real events, on a screen of its own.

#include "app/run_program.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <string>

namespace clay::studio {
namespace {

using test::claystack;
using test::Ran;
using test::read_text;
using test::ScratchFolder;
using test::shell;

class OnAScreen : public ::testing::Test {
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

TEST_F(OnAScreen, FromTheGalleryToAFileThatPrints) {
  const ScratchFolder folder;
  const Ran ran = run("under_xvfb.sh", folder);
  ASSERT_EQ(ran.status, 0) << ran.err << ran.out;
  const auto kept = nlohmann::json::parse(read_text(folder.file("config/claystack/studio.json")));
  EXPECT_NEAR(kept.at("scale"), 1.1, 1e-6) << "one step larger";
  EXPECT_EQ(claystack("check " + folder.file("bowl.stl")).status, 0);
  const std::string info = shell("prusa-slicer --info " + folder.file("bowl.stl")).out;
  EXPECT_NE(info.find("manifold = yes"), std::string::npos) << info;
}

TEST_F(OnAScreen, WhatIsNotRecoveredIsOfferedAgainUntilItIsDiscarded) {
  const ScratchFolder folder;
  test::write_text(folder.file("lump.scene.json"), read_text(test::sample("vase.scene.json")));
  const Ran ran = run("declined_under_xvfb.sh", folder);
  EXPECT_EQ(ran.status, 0) << ran.err << ran.out;
}

/// What is lost is bounded by how often the recorder looks, not by this machine: one of three times
/// it must be seen to hold.
TEST_F(OnAScreen, KilledInMidStrokeLosesATenthOfASecondAtMost) {
  double least_lost_ms = 1e9;
  for (int i = 0; i < 3 && least_lost_ms > 100.0; ++i) {
    const ScratchFolder folder;
    const Ran ran = run("killed_under_xvfb.sh", folder);
    ASSERT_EQ(ran.status, 0) << ran.err << ran.out;
    const auto nodes = nlohmann::json::parse(read_text(folder.file("tree.json"))).at("nodes");
    ASSERT_EQ(nodes.size(), 3u) << nodes;
    EXPECT_EQ(nodes[2].at("parent"), 1);
    const double kept_ms = 1e3 * nodes[2].at("seconds").get<double>();
    EXPECT_GT(kept_ms, 0.0);
    const double lasted_ms = std::stod(ran.out.substr(ran.out.rfind("lasted_ms ") + 10));
    EXPECT_GT(lasted_ms, 500.0);
    least_lost_ms = std::min(least_lost_ms, lasted_ms - kept_ms);
  }
  EXPECT_LE(least_lost_ms, 100.0);
}

}  // namespace
}  // namespace clay::studio
