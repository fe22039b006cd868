// Keys have the same effects as in other programs.

#include "tests/app/studio/window.hpp"

#include <cmath>
#include <string>

namespace clay::studio {
namespace {

using test::claystack;
using test::kPress;
using test::Ran;
using test::Window;

/// Lines of a script that expect a value to within 0.1 %.
std::string about(const std::string& fact, double value) {
  return "expect " + fact + " above " + std::to_string(0.999 * value) + "\nexpect " + fact +
         " below " + std::to_string(1.001 * value) + "\n";
}

// A drag of 100 px multiplies a value by e^0.6.
const double kDragged = std::exp(0.6);

/// A click, and a move that must not count as part of the drag.
std::string click(const std::string& button) {
  return "press " + button + "\nrelease " + button + "\nmove 450 300 over 0.1\n";
}

TEST_F(Window, BracketsAndFChangeTheSize) {
  const std::string drag = "move 400 300\nkey F\nmove 500 300 over 0.2\n";
  const std::string dragged = about("tool_mm", 10.0 * kDragged);
  const Ran ran =
      run(about("tool_mm", 10.0) + "key ]\n" + about("tool_mm", 11.0) + "key [\nkey [\n" +
          about("tool_mm", 10.0 / 1.1) + "key ]\n" + about("tool_mm", 10.0) +  //
          drag + dragged + "key Esc\n" + about("tool_mm", 10.0) +              //
          drag + dragged + click("right") + about("tool_mm", 10.0) +           //
          drag + dragged + click("left") + dragged + "expect throwing no\n");
  EXPECT_EQ(ran.status, 0) << ran.err;
}

TEST_F(Window, EachShapeKeepsItsSize) {
  const Ran ran = run("key R\nexpect tool_mm above 0\nkey S\nkey ]\n" + about("tool_mm", 11.0) +
                      "key E\nkey ]\nkey S\n" + about("tool_mm", 11.0));
  EXPECT_EQ(ran.status, 0) << ran.err;
}

TEST_F(Window, ShiftFChangesTheStiffnessButNotTheClay) {
  const std::string drag = "move 400 300\nkey Shift+F\nmove 500 300 over 0.2\n";
  const std::string dragged = about("stiffness", 0.015 * kDragged);
  const Ran ran =
      run(about("stiffness", 0.015) + drag + dragged + "key Esc\n" + about("stiffness", 0.015) +
          drag + dragged + click("left") + dragged + about("tool_mm", 10.0) + "expect strokes 0\n");
  EXPECT_EQ(ran.status, 0) << ran.err;
}

TEST_F(Window, SpacePausesAndResumes) {
  const Ran ran =
      run("key 1\nkey Space\nexpect paused yes\npoint 65 18\npress left\nexpect throwing no\n"
          "point 50 18 over 0.3\nrelease left\nexpect strokes 0\n"
          "key Space\nexpect paused no\n" +
          std::string(kPress) + "expect strokes 1\n");
  EXPECT_EQ(ran.status, 0) << ran.err;
}

TEST_F(Window, SpaceDuringAStrokeLeavesTheClayUnchanged) {
  const Ran ran =
      run("key 1\npoint 65 18\npress left\npoint 56 18 over 0.4\nwait 0.2\nkey Space\n"
          "save FOLDER/paused.pot.json\n");
  ASSERT_EQ(ran.status, 0) << ran.err;
  const Ran more =
      run("key 1\npoint 65 18\npress left\npoint 56 18 over 0.4\nwait 0.2\nkey Space\n"
          "point 40 18 over 0.4\nwait 0.5\nexpect throwing yes\nsave FOLDER/later.pot.json\n");
  ASSERT_EQ(more.status, 0) << more.err;
  EXPECT_EQ(test::read_text(folder.file("paused.pot.json")),
            test::read_text(folder.file("later.pot.json")));
}

TEST_F(Window, EscReleasesTheClay) {
  const Ran ran =
      run("key 1\npoint 65 18\npress left\npoint 56 18 over 0.4\nwait 0.2\nexpect contact yes\n"
          "expect force_n above 0\nkey Esc\nexpect throwing no\nexpect strokes 1\n"
          "point 50 18 over 0.3\nwait 0.2\nexpect throwing no\nexpect strokes 1\nrelease left\n");
  EXPECT_EQ(ran.status, 0) << ran.err;
}

TEST_F(Window, KeysOpenDialogsAndEscClosesThem) {
  std::string script;
  const auto card = [&](const std::string& chord, const std::string& overlay) {
    script += "key " + chord + "\nexpect overlay " + overlay + "\nkey Esc\nexpect overlay none\n";
  };
  card("?", "shortcuts");
  card("F1", "shortcuts");
  card("Ctrl+N", "gallery");
  card("Ctrl+O", "open");
  card("Ctrl+S", "save");
  card("Ctrl+Shift+S", "save");
  card("Ctrl+E", "export");
  card("Ctrl+,", "settings");
  const Ran ran = run(script + "expect strokes 0\nkey Ctrl+Q\nexpect closed yes\n");
  EXPECT_EQ(ran.status, 0) << ran.err;
}

TEST_F(Window, ArrowsWorkInMenusAndLettersDoNot) {
  const Ran ran = run(
      "key F10\nkey H\nkey Up\nkey Up\nkey Up\nkey Up\nkey Up\nkey Enter\nexpect overlay export\n"
      "key Esc\nexpect overlay none\nkey F10\nkey Esc\nkey H\n",
      "--size 960x640 --log");
  ASSERT_EQ(ran.status, 0) << ran.err;
  const auto exported = ran.out.find("action: file.export"), pinch = ran.out.find("tool.pinch");
  EXPECT_NE(exported, std::string::npos) << ran.out;
  EXPECT_GT(pinch, exported) << "H belongs to the open menu, and to the tool without it";
  EXPECT_NE(pinch, std::string::npos) << ran.out;
}

TEST_F(Window, BehindADialogKeysDoNotTurnTheView) {
  const std::string keys = "key 3\nkey Shift+C\nkey PageUp\nkey Home\nkey Num7\nkey G\n";
  const Ran ran = run("key 1\nkey Ctrl+E\n" + keys + "key Ctrl+L\nkey Esc\nkey F1\n" + keys +
                          "key Esc\nexpect azimuth_deg 0\nkey 3\nexpect azimuth_deg 90\n",
                      "--size 960x640 --log");
  ASSERT_EQ(ran.status, 0) << ran.err;
  const auto count = [&](const std::string& id) {
    std::size_t found = 0;
    for (std::size_t at = 0; (at = ran.out.find("action: " + id, at)) != std::string::npos; ++at)
      ++found;
    return found;
  };
  EXPECT_EQ(count("view."), 3u) << "front, theme and right side\n" << ran.out;
}

TEST_F(Window, F6GoesThroughThePanelsAndEscBack) {
  const std::string ellipse = "key Down\nkey Down\nkey Right\nkey Space\n";
  const Ran ran = run("key S\n" + about("tool_mm", 10.0) + "key F6\nkey H\n" + ellipse +
                          "expect paused no\nkey ]\nkey Ctrl+E\nexpect overlay export\nkey Esc\n"
                          "key Esc\nkey H\nkey F6\nkey F6\nkey T\n",
                      "--size 1280x800 --log");
  ASSERT_EQ(ran.status, 0) << ran.err;
  const auto pinch = ran.out.find("action: tool.pinch"), exported = ran.out.find("file.export");
  EXPECT_NE(exported, std::string::npos) << "keys with Ctrl are those of commands\n" << ran.out;
  EXPECT_GT(pinch, exported) << "letters are for the panels";
  EXPECT_NE(pinch, std::string::npos) << "and after Esc for the pot\n" << ran.out;
  EXPECT_NE(ran.out.find("action: tool.trim"), std::string::npos) << "after the last column too";
  EXPECT_EQ(ran.out.find("action: tool.larger"), std::string::npos) << ran.out;
}

TEST_F(Window, LeftAndRightGoFromMenuToMenu) {
  const Ran ran =
      run("key F10\nkey Right\nkey Right\nkey Left\nkey Right\nkey Up\nkey Enter\n"
          "key F10\nkey Left\nkey Up\nkey Enter\nexpect overlay shortcuts\nkey Esc\n",
          "--size 960x640 --log");
  ASSERT_EQ(ran.status, 0) << ran.err;
  const auto tool = ran.out.find("action: tool.strength"), keys = ran.out.find("action: help.keys");
  EXPECT_NE(tool, std::string::npos) << "the last enabled row of the third menu\n" << ran.out;
  EXPECT_GT(keys, tool) << "left of the first menu is the last";
}

TEST_F(Window, RightOpensTheListOfRecentFilesAndLeftClosesIt) {
  std::string down;
  for (int row = 0; row < 10; ++row) down += "key Down\n";
  const Ran ran = run("save FOLDER/a.work\nkey F10\n" + down +
                          "key Right\nkey Left\nkey Right\nkey Enter\nexpect overlay none\n"
                          "key F10\n" +
                          down + "key Right\nkey Left\nkey Left\nkey Up\nkey Enter\n",
                      "--size 960x640 --log");
  ASSERT_EQ(ran.status, 0) << ran.err;
  const auto saved = ran.out.find("saved: "), opened = ran.out.find("opened: ", saved);
  EXPECT_NE(opened, std::string::npos) << ran.out;
  EXPECT_NE(ran.out.find("action: help.keys", opened), std::string::npos) << ran.out;
}

/// From the gallery to a printable file: Show me throws the bowl. Saving sets the folder.
TEST_F(Window, KeysAloneMakeAPotAndItsFile) {
  test::write_text(
      folder.file("s"),
      "expect overlay gallery\nkey Down\nkey Enter\nexpect overlay none\nwait 150\n"
      "expect step finished\nexpect ready yes\nsave " +
          folder.file("keys.work") +
          "\nkey F10\nkey Right\nkey Left\nkey Up\nkey Up\nkey Up\nkey Up\nkey Up\nkey Enter\n"
          "expect overlay export\nwait 0.2\nkey Ctrl+Enter\nwait 0.2\n"
          "expect exported 1\n");
  const Ran ran = claystack("studio --script " + folder.file("s") + " --size 960x640");
  ASSERT_EQ(ran.status, 0) << ran.err;
  const Ran check = claystack("check " + folder.file("keys.3mf"));
  EXPECT_EQ(check.status, 0) << check.out << check.err;
}

TEST_F(Window, OpensADroppedFile) {
  const Ran ran = run(std::string(kPress) + "save FOLDER/mine.pot.json\nsave FOLDER/mine.work\n" +
                      "do edit.to_start\nsave FOLDER/mine.work\nopen FOLDER/mine.pot.json\n"
                      "expect strokes 0\nexpect unsaved no\nsave FOLDER/again.pot.json\n"
                      // An unknown file leaves the pot on the wheel.
                      "open FOLDER/s fails\nsave FOLDER/still.pot.json\n");
  ASSERT_EQ(ran.status, 0) << ran.err;
  const std::string mine = test::read_text(folder.file("mine.pot.json"));
  EXPECT_EQ(test::read_text(folder.file("again.pot.json")), mine);
  EXPECT_EQ(test::read_text(folder.file("still.pot.json")), mine);
}

TEST_F(Window, ATypedTextReplacesASelectedOne) {
  const Ran ran =
      run("save FOLDER/a.pot.json\ndo file.open\nwait 0.1\ntype none\nkey Ctrl+A\n"
          "type FOLDER/a.pot.json\nkey Enter\nwait 0.1\nexpect overlay none\n");
  EXPECT_EQ(ran.status, 0) << ran.err;
}

}  // namespace
}  // namespace clay::studio
