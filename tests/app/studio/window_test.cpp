// Strokes, the timeline and the picture.

#include "tests/app/studio/window.hpp"

#include <string>
#include <utility>

namespace clay::studio {
namespace {

using test::claystack;
using test::kDeeper;
using test::kPress;
using test::Ran;
using test::read_text;
using test::Window;

TEST_F(Window, ClickRemovesNothing) {
  const Ran ran =
      run("save FOLDER/before.pot.json\nkey 1\n"
          "point 40 15\npress left\npoint 40.5 15\nwait 1\nexpect contact no\nrelease left\n"
          "point 0 15\npress left\nwait 1\nexpect contact no\nrelease left\n"
          "save FOLDER/after.pot.json\n");
  ASSERT_EQ(ran.status, 0) << ran.err;
  // Only the motion of the tool may differ; the next stroke may continue it.
  const auto clay = [&](const char* name) {
    auto pot = nlohmann::json::parse(read_text(folder.file(name)));
    pot.erase("motion");
    return pot;
  };
  EXPECT_EQ(clay("before.pot.json"), clay("after.pot.json"));
}

TEST_F(Window, AWireThatCutsNothingIsNoStrokeAndSaysWhy) {
  const std::string pot = folder.file("cylinder.pot.json");
  ASSERT_EQ(
      claystack("throw -q " + test::sample("paper/cylinder.scene.json") + " -o " + pot).status, 0);
  const Ran ran =
      run("open " + pot +
          "\nkey 1\ndo tool.wire\n"
          "point 20 40\npress left\nwait 0.2\nexpect contact no\nrelease left\nwait 0.1\n"
          "expect strokes 0\nexpect unsaved no\nexpect banner \"\"\n"
          "point 80 40\npress left\npoint 60 40 over 0.4\nrelease left\nwait 0.1\n"
          "expect strokes 0\nexpect banner \"\"\n"
          // Into the wall, but not through it.
          "point 80 40\npress left\npoint 40 40 over 0.4\nwait 0.2\nexpect contact yes\n"
          "release left\nwait 0.1\nexpect strokes 0\nexpect unsaved no\n"
          "expect banner \"The wire did not reach the axis: nothing was cut\"\n"
          "do tool.needle\npoint 80 0\npress left\npoint 30 0 over 0.4\nwait 0.2\n"
          "release left\nwait 0.1\nexpect strokes 0\n"
          "expect banner \"The needle was on the wheel head: nothing was cut\"\n"
          // A quick drag goes all the way.
          "do tool.wire\npoint 80 40\npress left\npoint 0 40 over 0.25\nwait 0.1\n"
          "release left\nwait 0.1\nexpect strokes 1\nexpect height_mm below 170\n");
  EXPECT_EQ(ran.status, 0) << ran.err;
}

TEST_F(Window, CtrlTrimsAndPressKeepsTheClay) {
  const Ran ran = run(std::string(kPress) +
                      "save FOLDER/press.pot.json\nhold Ctrl\n"
                      "point 65 18\npress left\npoint 50 18 over 0.4\nwait 0.2\n"
                      "expect contact yes\nrelease left\n"
                      "save FOLDER/trim.pot.json\n");
  ASSERT_EQ(ran.status, 0) << ran.err;
  const auto ledger = [&](const char* pot) {
    return nlohmann::json::parse(read_text(folder.file(pot)))["ledger"];
  };
  EXPECT_EQ(ledger("press.pot.json")["trimmed"], "0") << ledger("press.pot.json");
  EXPECT_NE(ledger("trim.pot.json")["trimmed"], "0") << ledger("trim.pot.json");
}

TEST_F(Window, AMousePinchThinsTheWallAndKeepsTheClay) {
  const std::string pot = folder.file("cylinder.pot.json");
  ASSERT_EQ(
      claystack("throw -q " + test::sample("paper/cylinder.scene.json") + " -o " + pot).status, 0);
  const Ran ran = run("open " + pot +
                      "\nwait 0.1\nexpect thinnest_mm above 3.9\ndo tool.pinch\n"
                      // From a gap of 6 mm to one of 3.
                      "key ,\nkey ,\nkey ,\nkey ,\nkey ,\nkey ,\nkey 1\n"
                      "point 40 40\npress left\nwait 0.5\npoint 40 75 over 1.5\n"
                      "expect contact yes\nrelease left\nwait 0.1\n"
                      "expect thinnest_mm below 3.2\nexpect thinnest_mm above 2.8\n"
                      "expect volume_error 0\nexpect strokes 1\n");
  EXPECT_EQ(ran.status, 0) << ran.err;
}

/// The view stands still during a stroke, because in another view the pointer would mean another
/// place.
TEST_F(Window, TheViewStandsStillWhileThePointerLeadsTheTool) {
  const std::string begin = "key 1\npoint 65 18\npress left\npoint 54 18 over 0.4\nwait 0.2\n";
  const std::string end = "move 640 320\nwait 0.5\nrelease left\nwait 0.1\nsave FOLDER/";
  const std::string keys =  // seven frames
      "key 3\nkey 7\nkey Home\nkey PageUp\nscroll 4\nkey D\nkey Ctrl+=\n"
      "move 700 300\nexpect azimuth_deg 0\nexpect throwing yes\n";
  const Ran still = run(begin + "wait 0.1167\nmove 700 300\n" + end + "still.pot.json\n");
  ASSERT_EQ(still.status, 0) << still.err;
  const Ran keyed = run(begin + keys + end + "keyed.pot.json\nkey 3\nexpect azimuth_deg 90\n");
  ASSERT_EQ(keyed.status, 0) << keyed.err;
  EXPECT_EQ(read_text(folder.file("still.pot.json")), read_text(folder.file("keyed.pot.json")));
  const Ran pad =
      run("key 1\ngamepad \"Test pad\"\npoint 60 18\ntrigger right 1\n"
          "expect throwing yes\nstick right 1 0\nwait 0.3\nexpect azimuth_deg 0\n"
          "pad R3\npad L3\npress right\nmove 500 300\nrelease right\n"
          "expect azimuth_deg 0\ntrigger right 0\nwait 0.1\n"
          "expect azimuth_deg below -1\n");
  EXPECT_EQ(pad.status, 0) << pad.err;
}

TEST_F(Window, AnotherButtonDoesNotEndAStroke) {
  const Ran ran =
      run("key 1\npoint 65 18\npress left\npoint 54 18 over 0.4\n"
          "press right\nrelease right\nexpect throwing yes\n"
          "release left\nwait 0.1\nexpect throwing no\nexpect strokes 1\n");
  EXPECT_EQ(ran.status, 0) << ran.err;
}

TEST_F(Window, AStrokeFromAnEarlierPotIsABranch) {
  const Ran ran = run(std::string(kPress) + kDeeper +
                      "expect node 2\nsave FOLDER/two.pot.json\n"
                      "do edit.undo\n" +
                      kDeeper +
                      "expect node 3\nexpect strokes 3\n"
                      "do edit.other_branch\nexpect node 2\nsave FOLDER/again.pot.json\n"
                      "do edit.to_start\nexpect node 0\n");
  ASSERT_EQ(ran.status, 0) << ran.err;
  EXPECT_EQ(read_text(folder.file("two.pot.json")), read_text(folder.file("again.pot.json")));
}

TEST_F(Window, TheTimelineCanBeClickedAndDragged) {
  // The timeline is above the status bar; its cards begin beside "Start".
  const Ran ran = run(std::string(kPress) + kDeeper +
                      "save FOLDER/two.pot.json\n"
                      "move 99 570\npress left\nrelease left\nexpect node 0\n"
                      "move 178 570\npress left\nexpect scrubbing no\n"
                      "move 150 570 over 0.3\nexpect scrubbing yes\nexpect node 0\n"
                      "release left\nexpect scrubbing yes\nkey Esc\nexpect scrubbing no\n"
                      "expect node 0\nmove 178 570\npress left\nrelease left\nexpect node 1\n"
                      "do edit.redo\nexpect node 2\nsave FOLDER/again.pot.json\n");
  ASSERT_EQ(ran.status, 0) << ran.err;
  EXPECT_EQ(read_text(folder.file("two.pot.json")), read_text(folder.file("again.pot.json")));
}

/// The drag ends at a pixel of the timeline; the saved work holds the time of that pixel.
TEST_F(Window, BranchWithinAStrokeMatchesThrow) {
  const std::string drag = "move 178 570\npress left\nmove 150 570 over 0.3\nrelease left\n";
  const Ran ran = run(std::string(kPress) + drag +
                      "expect scrubbing yes\nexpect node 1\ndo edit.branch\n"
                      "expect scrubbing no\nexpect strokes 2\nexpect node 2\n"
                      "save FOLDER/mine.pot.json\nsave FOLDER/mine.work\n"
                      "do edit.other_branch\nexpect node 1\nsave FOLDER/whole.pot.json\n");
  ASSERT_EQ(ran.status, 0) << ran.err;
  for (const auto& [node, name] : {std::pair{1, "whole"}, std::pair{2, "mine"}}) {
    const std::string thrown = folder.file("thrown.pot.json");
    ASSERT_EQ(test::claystack("throw -q " + folder.file("mine.work") + " --at " +
                              std::to_string(node) + " -o " + thrown)
                  .status,
              0);
    EXPECT_EQ(read_text(thrown), read_text(folder.file(std::string(name) + ".pot.json"))) << name;
  }
  EXPECT_NE(read_text(folder.file("whole.pot.json")), read_text(folder.file("mine.pot.json")));
  // A stroke on the moment shown also branches there.
  const Ran pressed = run(std::string(kPress) + drag + "expect scrubbing yes\n" + kDeeper +
                          "expect strokes 3\nexpect node 3\ndo edit.undo\nexpect node 2\n"
                          "save FOLDER/again.pot.json\n");
  ASSERT_EQ(pressed.status, 0) << pressed.err;
  EXPECT_EQ(read_text(folder.file("again.pot.json")), read_text(folder.file("mine.pot.json")));
}

/// A moment of a stroke is shown: a file holds the current pot, which is shown first.
TEST_F(Window, WhatIsWrittenIsWhatIsShown) {
  const std::string scrub =
      "move 178 570\npress left\nmove 150 570 over 0.3\nrelease left\nexpect scrubbing yes\n";
  const Ran ran = run(std::string(kPress) + "save FOLDER/whole.pot.json\n" + scrub +
                      "save FOLDER/again.pot.json\nexpect scrubbing no\n" + scrub +
                      "do file.export\nexpect scrubbing no\nkey Esc\n" + scrub +
                      "do file.picture\nexpect scrubbing no\nkey Esc\n" + scrub +
                      "do file.save_as\nexpect scrubbing no\nkey Esc\n");
  ASSERT_EQ(ran.status, 0) << ran.err;
  EXPECT_EQ(read_text(folder.file("whole.pot.json")), read_text(folder.file("again.pot.json")));
}

TEST_F(Window, AClickInTheAirIsNoBranch) {
  const Ran ran = run(std::string(kPress) +
                      "move 178 570\npress left\nmove 150 570 over 0.3\nrelease left\n"
                      "point 65 18\npress left\nwait 0.2\nrelease left\n"
                      "expect scrubbing yes\nexpect strokes 1\n"
                      // Esc in the air goes back, and the button that is still held does nothing.
                      "press left\nkey Esc\nexpect scrubbing no\npoint 50 18 over 0.3\n"
                      "expect throwing no\nrelease left\nexpect strokes 1\n");
  EXPECT_EQ(ran.status, 0) << ran.err;
}

TEST_F(Window, TheNoteOnAMomentClosesWithIt) {
  const Ran ran = run(std::string(kPress) +
                      "move 178 570\npress left\nmove 150 570 over 0.3\nrelease left\n"
                      "do edit.branch\nexpect banner \"\"\n");
  EXPECT_EQ(ran.status, 0) << ran.err;
}

TEST_F(Window, UndoesSixtyFourStrokesOneByOne) {
  std::string script = "key 1\n";
  for (int i = 0; i < 64; ++i)
    script += "point 65 18\npress left\npoint 50 18 over 0.2\npoint 65 18 over 0.2\nrelease left\n";
  script += "expect strokes 64\n";
  for (int i = 0; i < 64; ++i) script += "key Ctrl+Z\n";
  const Ran ran = run("save FOLDER/before.pot.json\n" + script +
                      "expect can_undo no\nsave FOLDER/after.pot.json\n");
  ASSERT_EQ(ran.status, 0) << ran.err;
  EXPECT_EQ(read_text(folder.file("before.pot.json")), read_text(folder.file("after.pot.json")));
}

TEST_F(Window, AFallIsShownAndUndone) {
  std::string script =
      "open " + test::sample("collapse.scene.json") +
      "\nkey 1\nsave FOLDER/stands.pot.json\nscreenshot FOLDER/stands.png\nhold Ctrl\n"
      "point 55 22\npress left\npoint 13 22 over 2\n";
  // Until the neck fails.
  for (int i = 0; i < 40; ++i) script += "wait 0.05\n";
  script +=
      "release left\nhold\nexpect fallen yes\nwait 0.1\nexpect proved yes\nexpect thin no\n"
      "expect verdict \"Fallen: undo removes the last stroke\"\nkey 1\nscreenshot FOLDER/fell.png\n"
      "do file.export\nwait 0.1\nexpect triangles above 100\nkey Esc\n"
      "point 45 30\npress left\nrelease left\nexpect throwing no\n"
      "expect banner \"The clay has fallen: undo removes the last stroke\"\n"
      "key Ctrl+Z\nexpect fallen no\nexpect banner \"\"\nkey Ctrl+Y\nkey Ctrl+Z\nsave "
      "FOLDER/again.pot.json\n";
  const Ran ran = run(script);
  ASSERT_EQ(ran.status, 0) << ran.err;
  EXPECT_EQ(read_text(folder.file("stands.pot.json")), read_text(folder.file("again.pot.json")));
  EXPECT_NE(read_text(folder.file("stands.png")), read_text(folder.file("fell.png")));
}

TEST_F(Window, ChecksTheCurrentClayAndPlotsEveryTick) {
  const Ran ran = run(std::string("wait 0.1\nexpect proved yes\nexpect thinnest_mm above 39.99\n"
                                  "expect thinnest_mm below 40.01\nexpect plotted_ticks 0\n") +
                      kPress +
                      "wait 0.1\nexpect proved yes\nexpect thin no\nexpect stress_part above 0.01\n"
                      "expect stress_part below 1\nexpect thinnest_mm above 40.01\n"
                      "expect plotted_ticks 0\nkey Ctrl+Z\ndo view.servo\n" +
                      kPress + "wait 0.1\nexpect plotted_ticks above 800\n");
  EXPECT_EQ(ran.status, 0) << ran.err;
}

}  // namespace
}  // namespace clay::studio
