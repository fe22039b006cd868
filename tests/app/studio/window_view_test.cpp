// The camera and the layout of the window, while pots grow and windows are small.

#include "tests/app/studio/window.hpp"

namespace clay::test {
namespace {

/// A press from above opens the lump and pushes its wall out to a radius of 80 mm.
constexpr const char* kWiden =
    "key 1\npoint 20 60\npress left\npoint 20 20 over 2\npoint 35 12 over 2\n"
    "point 40 40 over 2\npoint 60 70 over 1\nrelease left\nexpect strokes 1\n";

TEST_F(Window, AViewThatWasMovedCloseStaysThereAfterAStroke) {
  const auto ran =
      run("key 1\nkey PageUp\nkey PageUp\nkey PageUp\nkey PageUp\n"
          "move 600 300\nhold Shift\npress middle\nmove 330 240 over 0.3\nrelease middle\nhold\n"
          "expect distance_mm below 194\nexpect distance_mm above 191\n"
          "point 60 20\npress left\npoint 45 20 over 1\nexpect contact yes\n"
          "point 60 20 over 1\nrelease left\nwait 0.2\nexpect strokes 1\n"
          "expect distance_mm below 194\nexpect distance_mm above 191\n");
  EXPECT_EQ(ran.status, 0) << ran.err;
}

TEST_F(Window, APotThatBecomesWiderStaysInSight) {
  const auto ran =
      run(std::string(kWiden) + "wait 0.2\npoint -88 45\npoint 88 45\n", "--size 640x480");
  EXPECT_EQ(ran.status, 0) << ran.err;
}

/// The near edge of the foot is lower in the picture than the middle of the foot.
TEST_F(Window, TheFootOfAPotThatGrowsStaysAboveTheTimeline) {
  const auto ran =
      run("point 0 70\npress left\npoint 0 15 over 2\npoint 20 15 over 2\npoint 22 60 over 1.5\n"
          "release left\nwait 0.3\nkey H\npoint 41 12\npress left\npoint 48 70 over 4\n"
          "point 50 90 over 2\nrelease left\nwait 0.3\nexpect height_mm above 100\n"
          "expect distance_mm above 450\n");
  EXPECT_EQ(ran.status, 0) << ran.err;
}

TEST_F(Window, UndoShowsAllOfATallerPot) {
  const auto ran =
      run(std::string(kWiden) +
          "do tool.needle\npoint 75 20\npress left\npoint 0 20 over 2\nrelease left\n"
          "expect height_mm below 25\nkey 1\nkey PageUp\nkey PageUp\nkey PageUp\nwait 0.1\n"
          "do edit.undo\nwait 0.1\nexpect height_mm above 45\npoint -80 45\npoint 80 45\n");
  EXPECT_EQ(ran.status, 0) << ran.err;
}

TEST_F(Window, DiagnosticsLeaveRoomForThePotInASmallWindow) {
  const auto ran =
      run("key 1\ndo view.diagnostics\nwait 0.1\npoint -48 20\npoint 48 20\n", "--size 640x480");
  EXPECT_EQ(ran.status, 0) << ran.err;
}

TEST_F(Window, AScriptShowsWhyACommandIsDisabled) {
  const auto ran = run("do edit.undo\n");
  EXPECT_EQ(ran.status, 1);
  EXPECT_NE(ran.err.find("found it disabled: there is no stroke to undo"), std::string::npos)
      << ran.err;
}

}  // namespace
}  // namespace clay::test
