// Files into the window and out of it, driven by scripts.

#include "window.hpp"

#include <filesystem>
#include <string>

namespace clay::studio {
namespace {

TEST_F(Window, TheExportIsThatOfTheCommandLineOnTheSameStrokes) {
  // The name and the folder of the work are those of its files.
  const Ran ran = run(std::string(kPress) +
                      "save FOLDER/mine.work\n"
                      "key Ctrl+E\nwait 0.1\nexpect overlay export\nexpect triangles above 100\n"
                      "key Ctrl+Enter\nwait 0.1\nexpect exported 1\n");
  ASSERT_EQ(ran.status, 0) << ran.err;
  std::filesystem::create_directory(folder.path() / "cli");
  const std::string pot = folder.file("cli/mine.pot.json"), stl = folder.file("cli/mine.stl");
  ASSERT_EQ(claystack("throw -q " + folder.file("mine.work") + " -o " + pot).status, 0);
  ASSERT_EQ(claystack("export -q " + pot + " " + stl).status, 0);
  EXPECT_EQ(read_text(folder.file("mine.stl")), read_text(stl));
  EXPECT_EQ(claystack("check " + folder.file("mine.stl")).status, 0);
}

TEST_F(Window, ADrawingIsPutOnTheWheelAndTheWorkBeforeIsAskedFor) {
  const std::string jug = test::sample("drawings/jug.svg");
  const Ran ran =
      run(std::string(kPress) + "open " + jug +
          "\nexpect overlay import\nexpect problem \"\"\ndo import.take\n"
          "expect overlay quit\nkey Esc\nexpect strokes 1\n"
          "open " +
          jug +
          "\ndo import.take\nkey Ctrl+D\n"
          "expect strokes 0\nexpect height_mm above 171.9\nexpect height_mm below 172.1\n"
          "save FOLDER/jug.pot.json\n");
  ASSERT_EQ(ran.status, 0) << ran.err;
  ASSERT_EQ(claystack("import " + jug + " -o " + folder.file("cli.pot.json")).status, 0);
  EXPECT_EQ(read_text(folder.file("jug.pot.json")), read_text(folder.file("cli.pot.json")));
}

TEST_F(Window, AnUnsavedWorkIsAskedForBeforeAnotherOpens) {
  const std::string vase = test::sample("vase.scene.json");
  const Ran ran = run(std::string(kPress) + "open " + vase +
                      "\nexpect overlay quit\nkey Esc\nexpect strokes 1\n"
                      "do file.new_vase\nexpect overlay quit\nkey Esc\nexpect strokes 1\n"
                      "save FOLDER/kept.work\n" +
                      kDeeper + "open " + vase +
                      "\nexpect overlay quit\nkey Enter\nexpect strokes 0\nexpect unsaved no\n"
                      "open FOLDER/kept.work\nexpect strokes 2\nexpect unsaved no\n");
  EXPECT_EQ(ran.status, 0) << ran.err;
}

TEST_F(Window, QuittingAsksOnceThereIsSomethingToLose) {
  Ran ran = run("close\nexpect closed yes\n");
  EXPECT_EQ(ran.status, 0) << ran.err;
  ran = run(std::string(kPress) +
            "close\nexpect overlay quit\nexpect closed no\nkey Esc\nexpect overlay none\n"
            "close\ndo quit.discard\nexpect closed yes\n");
  EXPECT_EQ(ran.status, 0) << ran.err;
}

TEST_F(Window, WhatIsWrongIsSaidWithItsLine) {
  Ran ran = run("wait 0.1\nexpect contact yes\n");
  EXPECT_EQ(ran.status, 1);
  EXPECT_NE(ran.err.find("s:2: contact: expected yes, found no"), std::string::npos) << ran.err;
  ran = run("do edit.undo\n");
  EXPECT_EQ(ran.status, 1) << ran.err;
  ran = run("fly away\n");
  EXPECT_EQ(ran.status, 2) << ran.err;
  ran = run("save FOLDER/pot.txt\n");
  EXPECT_EQ(ran.status, 3) << ran.err;
  EXPECT_EQ(claystack("studio --script /nonexistent").status, 3);
  EXPECT_EQ(claystack("studio nothing.scene.json --screenshot x.png").status, 2);
  EXPECT_EQ(claystack("studio --size 3x3 --screenshot x.png").status, 2);
}

}  // namespace
}  // namespace clay::studio
