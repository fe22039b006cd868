// One rule for files that exist, in every command that writes (docs/files.md, "Existing files").

#include "tests/support/run_program.hpp"

#include <gtest/gtest.h>

#include <filesystem>
#include <ostream>
#include <set>
#include <string>
#include <vector>

namespace clay::test {
namespace {

namespace fs = std::filesystem;

/// An output of a command. In the arguments @ is the folder of the inputs and # the output.
struct Writer {
  std::string name, arguments, ending;
  std::vector<std::string> inputs;
  std::string other_ending = ".txt";  ///< of another kind of file
  friend std::ostream& operator<<(std::ostream& out, const Writer& writer) {
    return out << writer.name;
  }
};

std::string replaced(std::string text, const std::string& old, const std::string& fresh) {
  for (std::size_t at = 0; (at = text.find(old, at)) != text.npos; at += fresh.size())
    text.replace(at, old.size(), fresh);
  return text;
}

std::vector<Writer> writers() {
  const std::string thrown = "throw -q @/a.scene.json ";
  const std::vector<std::string> played = {"a.scene.json", "a.session"};
  std::vector<Writer> all = {
      {"Throw", thrown + "-o #", ".pot.json", played, ".stl"},
      {"ThrowFromAPot",
       "throw -q --from @/a.pot.json -s @/a.session -o #",
       ".pot.cbor",
       {"a.pot.json", "a.session"}},
      {"ThrowAWork", "throw -q @/a.work -o #", ".pot.json", {"a.work"}},
      {"Trace", thrown + "--trace #", ".csv", played, ".session"},
      {"ErrorPlot", thrown + "--error-plot #", ".svg", played},
      {"Strokes",
       "strokes -q @/a.scene.json @/a.strokes.json -o #",
       ".session",
       {"a.scene.json", "a.strokes.json"},
       ".csv"},
      {"Export", "export -q --segments 16 @/a.pot.json #", ".stl", {"a.pot.json"}},
      {"ExportOfADrawing", "export -q @/a.pot.json #", ".svg", {"a.pot.json"}},
      {"ExportOfAPot", "export -q @/a.pot.json #", ".pot.cbor", {"a.pot.json"}},
      {"ExportWithAReport",
       "export -q --segments 16 --process @/a.process.json @/a.pot.json #.stl --report #",
       ".report.json",
       {"a.pot.json", "a.process.json"},
       ".pot.json"},
      {"Repair",
       "check -q --process @/a.process.json @/a.stl --repair -o #",
       ".obj",
       {"a.stl", "a.process.json"}},
  };
#ifdef CLAYSTACK_FALCON
  const std::string live = thrown + "--device simulated --seconds 1 ";
  all.push_back({"LivePot", live + "-o #", ".pot.json", played});
  all.push_back({"Recording", live + "--record #", ".session", played, ".csv"});
#endif
#ifdef CLAYSTACK_DRAWINGS
  all.push_back({"Import", "import -q @/a.csv --wall 4 -o #", ".pot.json", {"a.csv"}});
  all.push_back({"ImportOfAMesh", "import -q @/a.stl -o #", ".pot.json", {"a.stl"}});
#endif
#ifdef CLAYSTACK_WINDOW
  const std::string render = "render -q --size 64x64 @/a.pot.json ";
  all.push_back({"Picture", render + "-o #", ".png", {"a.pot.json"}});
  all.push_back({"Turntable", render + "--frames 2 --turntable #", ".gif", {"a.pot.json"}});
#endif
  return all;
}

class ExistingFiles : public testing::TestWithParam<Writer> {
 protected:
  static void SetUpTestSuite() {
    inputs_ = new ScratchFolder;
    for (const char* end : {".scene.json", ".session"})
      write_text(inputs_->file("a") + end, read_text(sample(std::string("bowl") + end)));
    write_text(inputs_->file("a.strokes.json"), R"({"start_mm": [120, 120],
        "strokes": [{"through_mm": [[110, 100], [110, 80]]}]})");
    write_text(inputs_->file("a.work"), read_text(sample("mouse.work")));
    write_text(inputs_->file("a.csv"), "radius_mm,height_mm\n30,0\n40,60\n");
    write_text(inputs_->file("a.process.json"),
               R"({"schema": "claystack-process-1", "name": "any",
                   "walls": [{"min_wall_mm": 0.001, "source": "none"}]})");
    const std::string pot = inputs_->file("a.pot.json");
    ASSERT_EQ(claystack("throw -q " + sample("bowl.scene.json") + " -o " + pot).status, 0);
    ASSERT_EQ(claystack("export -q --segments 64 " + pot + " " + inputs_->file("a.stl")).status, 0);
  }
  static void TearDownTestSuite() { delete inputs_; }

  [[nodiscard]] Ran run(const std::string& out, const std::string& more = "") const {
    const std::string at = inputs_->path().string();
    return claystack(replaced(replaced(GetParam().arguments, "@", at), "#", out) + more);
  }
  [[nodiscard]] std::string out() const { return folder_.file("out" + GetParam().ending); }

  void expect_refused(const std::string& path, int status, const std::string& reason,
                      const std::string& more = "") const {
    const Ran ran = run(path, more);
    EXPECT_EQ(ran.status, status) << path << ": " << ran.err;
    EXPECT_NE(ran.err.find(reason), std::string::npos) << ran.err;
  }

  static inline ScratchFolder* inputs_ = nullptr;
  const ScratchFolder folder_;
};

TEST_P(ExistingFiles, AreReplacedAsOftenAsACommandRuns) {
  write_text(out(), "old");
  ASSERT_EQ(run(out()).status, 0) << run(out()).err;
  EXPECT_NE(read_text(out()), "old");
  EXPECT_EQ(run(out()).status, 0);
}

TEST_P(ExistingFiles, StayWithNoOverwrite) {
  ASSERT_EQ(run(out(), " --no-overwrite").status, 0) << run(out()).err;
  for (const auto& file : fs::directory_iterator(folder_.path())) fs::remove(file);
  write_text(out(), "old");
  expect_refused(out(), 2, "expected a new file with --no-overwrite", " --no-overwrite");
  EXPECT_EQ(read_text(out()), "old");
}

TEST_P(ExistingFiles, AreReplacedBehindALinkThatStays) {
  const std::string target = folder_.file("target");
  write_text(target, "old");
  fs::create_symlink(target, out());
  ASSERT_EQ(run(out()).status, 0);
  EXPECT_TRUE(fs::is_symlink(out()));
  EXPECT_NE(read_text(target), "old");
}

TEST_P(ExistingFiles, StayIfTheyAreInputs) {
  for (const std::string& name : GetParam().inputs) {
    const std::string input = inputs_->file(name), before = read_text(input);
    expect_refused(input, 2, name);
    const std::string symbolic = folder_.file("s" + GetParam().ending);
    const std::string hard = folder_.file("h" + GetParam().ending);
    fs::create_symlink(input, symbolic);
    fs::create_hard_link(input, hard);
    expect_refused(symbolic, 2, "found the same file as the input " + input);
    expect_refused(hard, 2, "found the same file as the input " + input);
    EXPECT_EQ(read_text(input), before);
    EXPECT_EQ(read_text(hard), before);
    fs::remove(symbolic);
    fs::remove(hard);
  }
}

TEST_P(ExistingFiles, StayIfTheirNamesAreOfAnotherKind) {
  const std::string other = folder_.file("other" + GetParam().other_ending);
  write_text(other, "old");
  expect_refused(other, 2, "expected a name that ends in ");
  EXPECT_EQ(read_text(other), "old");
}

TEST_P(ExistingFiles, RefuseAFolderAndAMissingFolder) {
  fs::create_directory(out());
  expect_refused(out(), 3, "expected the name of a file, found a folder");
  expect_refused(folder_.file("none/out") + GetParam().ending, 3, "none/out");
}

INSTANTIATE_TEST_SUITE_P(Commands, ExistingFiles, testing::ValuesIn(writers()),
                         [](const auto& test) { return test.param.name; });

TEST(ExistingFilesOfACommand, TwoOutputsNeedTwoNames) {
  const ScratchFolder folder;
  const std::string scene = sample("bowl.scene.json"), pot = folder.file("a.pot.json");
  ASSERT_EQ(claystack("throw -q " + scene + " -o " + pot).status, 0);
  write_text(folder.file("b.stl"), "old");
  fs::create_symlink("later.stl", folder.file("dangling.stl"));
  const std::string export_pot = "export -q --segments 16 a.pot.json ";
  for (const std::string& command :
       {export_pot + "x.stl ./x.stl", export_pot + "b.stl " + folder.file("b.stl"),
        export_pot + "dangling.stl later.stl",
        export_pot + "../" + folder.path().filename().string() + "/y.obj y.obj"}) {
    const Ran ran = shell("cd " + folder.path().string() + " && " CLAYSTACK_PROGRAM " " + command);
    EXPECT_EQ(ran.status, 2) << command;
    EXPECT_NE(ran.err.find("found the same file as the output"), std::string::npos) << ran.err;
  }
  EXPECT_EQ(read_text(folder.file("b.stl")), "old");
}

/// The results of a batch are the exception: they grow.
TEST(ExistingFilesOfACommand, StandardOutputTakesOneDocument) {
  const ScratchFolder folder;
  const std::string scene = sample("bowl.scene.json"), pot = folder.file("a.pot.json");
  ASSERT_EQ(claystack("throw -q " + scene + " -o " + pot).status, 0);
  std::vector<std::string> commands = {
      "throw " + scene + " -o - --json",
      "throw " + scene + " -o - --trace -",
      "throw " + sample("mouse.work") + " -o - --json",
      "export " + pot + " - --json",
      "export " + pot + " - -",
      "check " + pot + " --repair -o - --json",
  };
#ifdef CLAYSTACK_FALCON
  commands.push_back("throw " + scene + " --device simulated --seconds 0.1 -o - --json");
  commands.push_back("throw " + scene + " --device simulated --seconds 0.1 -o - --record -");
#endif
#ifdef CLAYSTACK_DRAWINGS
  commands.push_back("import " + sample("drawings/jug.svg") + " -o - --json");
#endif
  for (const std::string& command : commands) {
    const Ran ran = claystack(command);
    EXPECT_EQ(ran.status, 2) << command;
    EXPECT_NE(ran.err.find("standard output"), std::string::npos) << ran.err;
  }
}

TEST(ExistingFilesOfACommand, StandardInputHoldsOneDocument) {
  const ScratchFolder folder;
  const std::string session = folder.file("a.session");
  const std::vector<std::string> commands = {"throw - -s -", "throw - -s a.session --from -",
                                             "strokes - - -o " + session,
                                             "check - --certificate -"};
  for (const std::string& command : commands) {
    const Ran run = claystack(command + " </dev/null");
    EXPECT_EQ(run.status, 2);
    EXPECT_EQ(run.err, "claystack: -: expected at most one input on standard input, found 2\n")
        << command;
  }
}

TEST(ExistingFilesOfACommand, BatchAppendsToItsOwnResultsOnly) {
  const ScratchFolder folder;
  const std::string jobs = folder.file("jobs.jsonl"), results = folder.file("results.jsonl");
  const auto job = [](const std::string& id) {
    return R"({"id":")" + id + R"(","run":["plan",")" + sample("bowl.scene.json") + "\"]}\n";
  };
  write_text(jobs, job("one"));
  ASSERT_EQ(claystack("batch -q " + jobs + " -o " + results).status, 0);
  const std::string first = read_text(results);
  write_text(jobs, job("one") + job("two"));
  ASSERT_EQ(claystack("batch -q " + jobs + " -o " + results).status, 0);
  EXPECT_TRUE(read_text(results).starts_with(first));
  EXPECT_GT(read_text(results).size(), first.size());
  write_text(results, "a note\n");
  EXPECT_EQ(claystack("batch -q " + jobs + " -o " + results).status, 2);
  EXPECT_EQ(read_text(results), "a note\n");
  fs::create_hard_link(jobs, folder.file("linked.jsonl"));
  EXPECT_EQ(claystack("batch -q " + jobs + " -o " + folder.file("linked.jsonl")).status, 2);
}

/// A new command with an output has to join the table above.
TEST(ExistingFilesOfACommand, EveryCommandThatWritesIsTested) {
  std::set<std::string> tested{"bench"};  // its own test
  for (const Writer& writer : writers())
    tested.insert(writer.arguments.substr(0, writer.arguments.find(' ')));
  for (const char* command : {"throw", "export", "check", "strokes", "plan", "import", "render",
                              "devices", "bench", "studio", "batch", "doctor"}) {
    const Ran help = claystack(std::string("help ") + command);
    if (help.out.find("--no-overwrite") == std::string::npos) continue;
    EXPECT_TRUE(tested.contains(command)) << command;
  }
}

}  // namespace
}  // namespace clay::test
