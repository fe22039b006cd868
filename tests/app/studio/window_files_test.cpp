// The files of the window are those of the commands.

#include "tests/app/studio/window.hpp"

#include <filesystem>
#include <string>

namespace clay::studio {
namespace {

using test::claystack;
using test::kDeeper;
using test::kPress;
using test::Ran;
using test::read_text;
using test::shell;
using test::Window;

TEST_F(Window, UndoneAndRedoneStrokeEqualsThrow) {
  const Ran ran = run(std::string(kPress) +
                      "expect strokes 1\nexpect volume_error 0\nsave FOLDER/one.pot.json\n"
                      "key Ctrl+Z\nexpect can_undo no\nsave FOLDER/none.pot.json\n"
                      "key Ctrl+Shift+Z\nexpect can_redo no\nsave FOLDER/again.pot.json\n"
                      "expect unsaved yes\nsave FOLDER/bowl.work\nexpect unsaved no\n");
  ASSERT_EQ(ran.status, 0) << ran.err;
  const std::string one = read_text(folder.file("one.pot.json"));
  EXPECT_EQ(one, read_text(folder.file("again.pot.json")));
  EXPECT_NE(one, read_text(folder.file("none.pot.json")));
  const Ran thrown =
      claystack("throw " + folder.file("bowl.work") + " -o " + folder.file("thrown.pot.json"));
  ASSERT_EQ(thrown.status, 0) << thrown.err;
  EXPECT_EQ(one, read_text(folder.file("thrown.pot.json")));
}

TEST_F(Window, TheSameStrokeGivesTheSamePotFromWorkPotAndPrintFile) {
  ASSERT_EQ(run(std::string(kPress) +
                "save FOLDER/mine.work\nsave FOLDER/mine.pot.json\nsave FOLDER/mine.pot.cbor\n")
                .status,
            0);
  ASSERT_EQ(
      claystack("export -q " + folder.file("mine.pot.json") + " " + folder.file("mine.3mf")).status,
      0);
  EXPECT_NE(read_text(folder.file("mine.pot.json")).find("\"thrown_with\""), std::string::npos);
  std::string of_work;
  for (const char* name : {"mine.work", "mine.pot.json", "mine.pot.cbor", "mine.3mf"}) {
    // The tool comes from the file, not from the earlier choice.
    const Ran ran = run("key R\nopen FOLDER/" + std::string(name) + "\nkey 1\n" + kDeeper +
                        "save FOLDER/again.pot.json\n");
    ASSERT_EQ(ran.status, 0) << name << ran.err;
    const std::string again = read_text(folder.file("again.pot.json"));
    if (of_work.empty()) of_work = again;
    EXPECT_TRUE(again == of_work) << name;
  }
  EXPECT_NE(of_work, read_text(folder.file("mine.pot.json")));
}

TEST_F(Window, TheSameStrokeGivesTheSamePotFromADrawingAndItsPot) {
  const std::string jug = test::sample("drawings/jug.svg");
  const std::string stroke =
      "key 1\npoint 80 90\npress left\npoint 40 90 over 0.4\nwait 0.2\n"
      "expect contact yes\npoint 80 90 over 0.3\nwait 0.2\nrelease left\n"
      "expect strokes 1\n";
  ASSERT_EQ(claystack("import " + jug + " -o " + folder.file("jug.pot.json")).status, 0);
  Ran ran = run("open " + jug + "\ndo import.take\n" + stroke + "save FOLDER/drawn.pot.json\n");
  ASSERT_EQ(ran.status, 0) << ran.err;
  ran = run("open FOLDER/jug.pot.json\n" + stroke + "save FOLDER/read.pot.json\n");
  ASSERT_EQ(ran.status, 0) << ran.err;
  EXPECT_EQ(read_text(folder.file("drawn.pot.json")), read_text(folder.file("read.pot.json")));
}

TEST_F(Window, AScriptAlwaysGivesTheSameBytes) {
  ASSERT_EQ(run(std::string(kPress) + "save FOLDER/a.pot.json\nsave FOLDER/a.work\n").status, 0);
  ASSERT_EQ(run(std::string(kPress) + "save FOLDER/b.pot.json\nsave FOLDER/b.work\n").status, 0);
  EXPECT_EQ(read_text(folder.file("a.pot.json")), read_text(folder.file("b.pot.json")));
  EXPECT_EQ(read_text(folder.file("a.work")), read_text(folder.file("b.work")));
}

TEST_F(Window, QuittingAsksAboutUnsavedChanges) {
  Ran ran = run("close\nexpect closed yes\n");
  EXPECT_EQ(ran.status, 0) << ran.err;
  ran = run(std::string(kPress) +
            "close\nexpect overlay quit\nexpect closed no\nkey Esc\nexpect overlay none\n"
            "close\ndo quit.discard\nexpect closed yes\n");
  EXPECT_EQ(ran.status, 0) << ran.err;
}

TEST_F(Window, ExportMatchesTheCommand) {
  // The files take name and folder of the work.
  const Ran ran = run(std::string(kPress) +
                      "save FOLDER/mine.work\n"
                      "key Ctrl+E\nwait 0.1\nexpect overlay export\nexpect triangles above 100\n"
                      "key Ctrl+Enter\nwait 0.1\nexpect exported 1\n");
  ASSERT_EQ(ran.status, 0) << ran.err;
  std::filesystem::create_directory(folder.path() / "cli");
  const std::string pot = folder.file("cli/mine.pot.json"), print = folder.file("cli/mine.3mf");
  ASSERT_EQ(claystack("throw -q " + folder.file("mine.work") + " -o " + pot).status, 0);
  ASSERT_EQ(claystack("export -q " + pot + " " + print).status, 0);
  EXPECT_EQ(read_text(folder.file("mine.3mf")), read_text(print));
  EXPECT_EQ(claystack("check " + folder.file("mine.3mf")).status, 0);
}

/// From strokes to export: the commands make the same files from the saved work.
TEST_F(Window, EditedPotMatchesTheCommands) {
  const Ran ran = run(std::string(kPress) +
                      "save FOLDER/pressed.pot.json\nkey Ctrl+Z\nexpect node 0\n"
                      "save FOLDER/undone.pot.json\nkey Ctrl+Shift+Z\nexpect node 1\n"
                      "hold Ctrl\npoint 65 10\npress left\npoint 50 10 over 0.4\n"
                      "expect contact yes\npoint 65 10 over 0.2\nrelease left\nhold\n"
                      "expect strokes 2\nexpect volume_error 0\n"
                      "save FOLDER/mine.pot.json\nsave FOLDER/mine.work\n"
                      "do file.export\nwait 0.1\ndo export.write\nwait 0.1\nexpect exported 1\n");
  ASSERT_EQ(ran.status, 0) << ran.err;
  std::filesystem::create_directory(folder.path() / "cli");
  const auto thrown = [&](const std::string& options, const std::string& name) {
    return claystack("throw -q " + folder.file("mine.work") + options + " -o " +
                     folder.file("cli/" + name))
        .status;
  };
  const auto same = [&](const std::string& name) {
    return shell("cmp " + folder.file(name) + " " + folder.file("cli/" + name)).status == 0;
  };
  ASSERT_EQ(thrown(" --at 0", "undone.pot.json"), 0);
  ASSERT_EQ(thrown(" --at 1", "pressed.pot.json"), 0);
  ASSERT_EQ(thrown("", "mine.pot.json"), 0);
  ASSERT_EQ(
      claystack("export -q " + folder.file("cli/mine.pot.json") + " " + folder.file("cli/mine.3mf"))
          .status,
      0);
  for (const char* name : {"undone.pot.json", "pressed.pot.json", "mine.pot.json", "mine.3mf"})
    EXPECT_TRUE(same(name)) << name;
  EXPECT_FALSE(
      shell("cmp " + folder.file("pressed.pot.json") + " " + folder.file("mine.pot.json")).status ==
      0);
  const auto ledger = nlohmann::json::parse(read_text(folder.file("mine.pot.json")))["ledger"];
  EXPECT_NE(ledger["trimmed"], "0") << ledger;
}

TEST_F(Window, FallenPotIsShownAndExportedButNotThrown) {
  const std::string fallen = folder.file("fallen.pot.json");
  const Ran thrown = claystack("throw -q " + test::sample("collapse.scene.json") + " -s " +
                               test::sample("collapse.session") + " -o " + fallen);
  ASSERT_LE(thrown.status, 1) << thrown.err;
  const Ran ran =
      run("open FOLDER/fallen.pot.json\nexpect fallen yes\nexpect can_undo no\nkey 1\n"
          "wait 0.1\nexpect proved yes\n"
          "expect verdict \"Fallen: no stroke is possible, but it can be exported\"\n"
          "screenshot FOLDER/fallen.png\npoint 50 10\npress left\nexpect throwing no\n"
          "expect banner \"The clay has fallen: no stroke is possible, but it can be "
          "exported\"\nrelease left\n"
          "save FOLDER/fallen.work\ndo file.export\nwait 0.1\nexpect triangles above 100\n"
          "do export.write\nwait 0.1\nexpect exported 1\nkey Esc\n"
          "open FOLDER/fallen.work\nexpect fallen yes\nsave FOLDER/again.pot.json\n");
  ASSERT_EQ(ran.status, 0) << ran.err;
  EXPECT_EQ(read_text(fallen), read_text(folder.file("again.pot.json")));
  ASSERT_LE(claystack("export -q " + fallen + " " + folder.file("cli.3mf")).status, 1);
  EXPECT_EQ(read_text(folder.file("fallen.3mf")), read_text(folder.file("cli.3mf")));
}

TEST_F(Window, AcceptsADroppedProcess) {
  const std::string process = test::sample("workshop.process.json");
  Ran ran =
      run("open " + process + "\nexpect process " + process +
          "\nwait 0.1\nexpect thin no\ndo file.export\nwait 0.1\nexpect process " + process + "\n");
  EXPECT_EQ(ran.status, 0) << ran.err;
  // Dropped on the export dialog, the process applies to the export, as in the command.
  ran = run("save FOLDER/mine.work\nsave FOLDER/mine.pot.json\ndo file.export\nopen " + process +
            "\nwait 0.1\nexpect process " + process +
            "\ndo export.write\nwait 0.1\nexpect exported 1\n");
  ASSERT_EQ(ran.status, 0) << ran.err;
  const Ran command = claystack("export -q " + folder.file("mine.pot.json") + " " +
                                folder.file("cli.3mf") + " --process " + process);
  ASSERT_EQ(command.status, 0) << command.err;
  EXPECT_EQ(read_text(folder.file("mine.3mf")), read_text(folder.file("cli.3mf")));
  test::write_text(folder.file("bad.process.json"), "{}");
  ran = run("open FOLDER/bad.process.json fails\nexpect process \"\"\n", "--log --size 960x640");
  EXPECT_EQ(ran.status, 0) << ran.err;
  EXPECT_NE(ran.out.find("error: "), std::string::npos) << ran.out;
}

TEST_F(Window, ImportAsksAboutAnUnsavedWork) {
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

TEST_F(Window, SeveralFilesAtOnceAreRefused) {
  const std::string two =
      "open " + test::sample("vase.scene.json") + " " + test::sample("bottle.scene.json");
  Ran ran = run(std::string(kPress) + two +
                " fails\nexpect overlay none\nexpect strokes 1\n"
                "expect banner \"expected one file, found 2: drop one file at a time\"\n");
  EXPECT_EQ(ran.status, 0) << ran.err;
  ran = run(two + "\n");
  EXPECT_EQ(ran.status, 2);
  EXPECT_NE(ran.err.find("s:1: expected one file, found 2"), std::string::npos) << ran.err;
}

TEST_F(Window, OpeningAsksAboutAnUnsavedWork) {
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

/// Two strokes undercut the lump until it falls. Then the guide offers undo and no further step.
TEST_F(Window, AFallenPotEndsNoLesson) {
  const std::string fall =
      "do file.learn_bowl\nwait 0.3\n"
      "point 55 20\npress left\npoint 20 20 over 3\nrelease left\nwait 0.5\n"
      "point 55 20\npress left\npoint 10 20 over 3\nrelease left\nwait 0.5\nexpect fallen yes\n";
  Ran ran = run(fall + "do help.next_step\n", "");
  EXPECT_EQ(ran.status, 1);
  EXPECT_NE(ran.err.find("help.next_step"), std::string::npos) << ran.err;
  ran = run(fall + "do edit.undo\nexpect fallen no\ndo help.next_step\n", "");
  EXPECT_EQ(ran.status, 0) << ran.err;
}

TEST_F(Window, ScriptErrorsNameTheLine) {
  Ran ran = run("wait 0.1\nexpect contact yes\n");
  EXPECT_EQ(ran.status, 1);
  EXPECT_NE(ran.err.find("s:2: contact: expected yes, found no"), std::string::npos) << ran.err;
  ran = run("do edit.undo\n");
  EXPECT_EQ(ran.status, 1) << ran.err;
  ran = run("fly away\n");
  EXPECT_EQ(ran.status, 2) << ran.err;
  ran = run("save FOLDER/pot.txt\n");
  EXPECT_EQ(ran.status, 2) << ran.err;
  EXPECT_NE(ran.err.find("pot.txt: expected a name that ends in .work"), std::string::npos)
      << ran.err;
  ran = run("save FOLDER/none/pot.work\n");
  EXPECT_EQ(ran.status, 3) << ran.err;
  EXPECT_NE(ran.err.find("No such file or directory"), std::string::npos) << ran.err;
  EXPECT_EQ(claystack("studio --script /nonexistent").status, 3);
  EXPECT_EQ(claystack("studio nothing.scene.json --screenshot x.png").status, 3);
  ran = run("open nothing.pot.json\n");
  EXPECT_EQ(ran.status, 3) << ran.err;
  EXPECT_NE(ran.err.find("s:1: nothing.pot.json"), std::string::npos) << ran.err;
  ran = run("open " + test::sample("vase.scene.json") + " fails\n");
  EXPECT_EQ(ran.status, 1) << ran.err;
  ran = run("point 5000 10\npress left\n");
  EXPECT_EQ(ran.status, 1) << "outside the view";
  ran = run("move 9999 10\npress left\n");
  EXPECT_EQ(ran.status, 1) << "outside the window";
  EXPECT_EQ(claystack("studio --size 3x3 --screenshot x.png").status, 2);
  ran = claystack("studio a.pot.json b.pot.json");
  EXPECT_EQ(ran.status, 2);
  EXPECT_NE(ran.err.find("b.pot.json; the window opens one file\n"), std::string::npos) << ran.err;
  EXPECT_EQ(claystack("studio " + test::sample("vase.scene.json") + " --screenshot x.stl").status,
            2);
  EXPECT_EQ(run("screenshot FOLDER/pot.json\n").status, 2);
}

TEST_F(Window, APictureDoesNotReplaceItsInput) {
  const std::string link = folder.file("picture.png");
  test::write_text(folder.file("a.scene.json"), test::read_text(test::sample("vase.scene.json")));
  std::filesystem::create_symlink(folder.file("a.scene.json"), link);
  const auto ran = claystack("studio " + folder.file("a.scene.json") + " --screenshot " + link);
  EXPECT_EQ(ran.status, 2) << ran.err;
  EXPECT_NE(ran.err.find("found the same file as the input"), std::string::npos) << ran.err;
  EXPECT_EQ(test::read_text(folder.file("a.scene.json")),
            test::read_text(test::sample("vase.scene.json")));
}

}  // namespace
}  // namespace clay::studio
