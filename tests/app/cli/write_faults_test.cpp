// Every write call of a command fails once, or the program is killed at it (fault_shim.cpp): either
// all outputs exist or none, and no other files.

#include "tests/support/run_program.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cerrno>
#include <csignal>
#include <cstdint>
#include <cstring>
#include <map>
#include <regex>
#include <vector>

namespace clay::test {
namespace {

namespace fs = std::filesystem;
using Files = std::map<std::string, std::string>;  ///< bytes by name, without the times of reports

Files files_in(const fs::path& folder) {
  static const std::regex times(R"("seconds": [-+.\de]+|[.\d]+ ms)");
  Files files;
  for (const auto& entry : fs::directory_iterator(folder))
    files[entry.path().filename().string()] =
        std::regex_replace(read_text(entry.path().string()), times, "");
  return files;
}

/// A fault of the file system, as fault_shim.cpp describes.
struct Fault {
  int at = 0;  ///< the call that fails, from 1; 0: none
  int error = 0;
  int signal = 0;  ///< instead of an error
  std::string without = {};
};

constexpr int kErrors[] = {ENOSPC, EIO, EROFS};
constexpr int kFewestCalls = 5, kMostCalls = 300;

/// The folders of a command, and the command with a fault: @ is the input folder, # the output
/// folder.
class Folders {
 public:
  [[nodiscard]] Ran run(const std::string& arguments, const Fault& fault = {}) const {
    fs::remove(log());
    std::string line = "env XDG_STATE_HOME=" + state.path().string() +
                       " ASAN_OPTIONS=verify_asan_link_order=0 LD_PRELOAD=" CLAYSTACK_FAULT_SHIM;
    const auto set = [&](const std::string& name, const std::string& value) {
      line += " CLAYSTACK_FAULT_" + name + "=" + value;
    };
    set("FOLDER", out.path().string());
    set("AT", std::to_string(fault.at));
    set("ERRNO", std::to_string(fault.error));
    set("SIGNAL", std::to_string(fault.signal));
    set("LOG", log());
    set("WITHOUT", fault.without);
    line += " " CLAYSTACK_PROGRAM " ";
    for (const char c : arguments)
      line += c == '@' ? in.path().string() : c == '#' ? out.path().string() : std::string(1, c);
    return shell(line);
  }

  /// Leaves these files in the output folder.
  void reset(const Files& files) const {
    for (const auto& entry : fs::directory_iterator(out.path())) fs::remove(entry.path());
    for (const auto& [name, bytes] : files) write_text(out.file(name), bytes);
  }

  /// Runs the command with an error in its first write call, then in its second and so on, and
  /// `use(ran, error)` after each run, until it makes no more calls; there are more than `fewest`.
  template <class Use>
  void fail_each_call(const std::string& arguments, const Files& before, Fault fault, int fewest,
                      Use use) const {
    for (fault.at = 1;; ++fault.at) {
      ASSERT_LT(fault.at, kMostCalls);
      fault.error = kErrors[fault.at % 3];
      reset(before);
      const Ran ran = run(arguments, fault);
      const std::string call = read_text(log());
      if (call.empty()) {
        EXPECT_GT(fault.at, fewest);
        EXPECT_EQ(ran.status, 0) << ran.err;
        return;
      }
      SCOPED_TRACE(call + ", call " + std::to_string(fault.at) + ": " + std::strerror(fault.error) +
                   "\n" + ran.err);
      use(ran, fault.error);
    }
  }

  ScratchFolder in, out, state;

 private:
  [[nodiscard]] std::string log() const { return in.file("log"); }
};

struct FailingCall {
  std::string name;
  std::string arguments;
  std::vector<std::string> outputs;
  bool replaces = false;     ///< files of these names exist before
  std::string without = {};  ///< as CLAYSTACK_FAULT_WITHOUT
  int signal = 0;            ///< instead of an error
};

void PrintTo(const FailingCall& c, std::ostream* out) { *out << c.name; }

class WriteFaults : public testing::TestWithParam<FailingCall> {
 protected:
  void SetUp() override {
    const ScratchFolder& inputs = folders.in;
    const std::string session = read_text(sample("cylinder.session"));
    const std::size_t header = session.find('\n') + 1;
    write_text(inputs.file("a.session"), session.substr(0, session.find('\n', header) + 1));
    write_text(inputs.file("a.scene.json"), read_text(sample("cylinder.scene.json")));
    write_text(inputs.file("a.csv"), read_text(sample("drawings/tumbler.csv")));
    write_text(inputs.file("a.strokes.json"), read_text(sample("strokes/lip.strokes.json")));
    const std::string scene = inputs.file("a.scene.json");
    ASSERT_EQ(claystack("throw -q " + scene + " -o " + inputs.file("a.pot.json")).status, 0);
    // A cup of 40 segments without its first facet.
    ASSERT_EQ(claystack("export -q --segments 40 " + inputs.file("a.pot.json") + " " +
                        inputs.file("whole.stl"))
                  .status,
              0);
    std::string stl = read_text(inputs.file("whole.stl"));
    std::uint32_t facets = 0;
    std::memcpy(&facets, stl.data() + 80, 4);
    --facets;
    stl.erase(84, 50);
    std::memcpy(stl.data() + 80, &facets, 4);
    write_text(inputs.file("open.stl"), stl);
    if (GetParam().replaces)
      for (const std::string& name : GetParam().outputs) before[name] = "old " + name;
  }

  /// Without an error of a write call.
  [[nodiscard]] Ran run() const {
    return folders.run(GetParam().arguments, {0, 0, GetParam().signal, GetParam().without});
  }

  void expect_names_a_file(const std::string& message, int error) const {
    bool named = false;
    for (const std::string& name : GetParam().outputs)
      named = named || message.find(folders.out.file(name)) != std::string::npos;
    EXPECT_TRUE(named) << message;
    EXPECT_NE(message.find(std::strerror(error)), std::string::npos) << message;
  }

  Folders folders;
  Files before, whole;
};

TEST_P(WriteFaults, WriteAllOrNothing) {
  const FailingCall& call = GetParam();
  folders.reset(before);
  ASSERT_EQ(run().status, 0);
  whole = files_in(folders.out.path());
  ASSERT_EQ(whole.size(), call.outputs.size());

  folders.fail_each_call(call.arguments, before, {0, 0, call.signal, call.without}, kFewestCalls,
                         [&](const Ran& ran, int error) {
                           if (call.signal == SIGKILL) {  // the next writer finds the leftovers
                             ASSERT_EQ(run().status, 0);
                             EXPECT_TRUE(files_in(folders.out.path()) == whole);
                             return;
                           }
                           const Files after = files_in(folders.out.path());
                           if (call.signal != 0) {
                             EXPECT_EQ(ran.status, 128 + call.signal);
                             EXPECT_TRUE(after == before || after == whole);
                           } else if (ran.status == 0) {
                             EXPECT_TRUE(after == whole);
                           } else {
                             EXPECT_EQ(ran.status, 3);
                             EXPECT_TRUE(after == before);
                             expect_names_a_file(ran.err, error);
                           }
                           if (HasFailure())
                             for (const auto& [name, bytes] : after)
                               ADD_FAILURE() << name << ": " << bytes.size();
                         });
}

// Files that are written again have the same bytes, apart from the times in reports.
const std::string kExport =
    "export -q --segments 16 @/a.pot.json #/a.stl #/b.obj #/c.drc #/d.ply #/e.3mf #/f.glb";
const std::vector<std::string> kMeshes = {"a.stl", "b.obj", "c.drc", "d.ply", "e.3mf", "f.glb"};
const std::string kSection =
    "export -q @/a.pot.json #/a.step #/b.svg #/c.dxf #/d.pdf #/e.csv --report "
    "#/r.json";
const std::vector<std::string> kDrawings = {"a.step", "b.svg", "c.dxf", "d.pdf", "e.csv", "r.json"};
const std::string kPage =
    "export -q --segments 16 @/a.pot.json #/a.glb --glb meshopt --wall-map --report #/r.html";
const std::vector<std::string> kPageFiles = {"a.glb", "r.html"};
const std::string kThrow = "throw -q @/a.scene.json -o #/a.pot.json --trace #/trace.csv";
const std::vector<std::string> kPot = {"a.pot.json", "trace.csv"};
const std::string kRepair = "check -q --repair @/open.stl -o #/a.stl";
const std::string kDecimate = "check -q --max-triangles 1000 @/whole.stl -o #/a.stl";
const std::string kStrokes = "strokes -q --from @/a.pot.json @/a.strokes.json -o #/a.session";
const std::string kDrawing = "import -q @/a.csv -o #/a.pot.json";
const std::string kMesh = "import -q @/whole.stl -o #/a.pot.cbor";
const std::string kRender =
    "render -q @/a.pot.json -o #/a.png --turntable #/a.gif --frames 2 --size 64x64";
const std::string kCopy = "throw -q --from @/a.pot.json -s @/a.session -o #/a.pot.cbor";
const std::string kStick = "tmpfile,links";  // FAT, as on USB drives

INSTANTIATE_TEST_SUITE_P(
    Commands, WriteFaults,
    testing::Values(
        FailingCall{"Export", kExport, kMeshes},
        FailingCall{"ExportOverOldFiles", kExport, kMeshes, true},
        FailingCall{"ExportToAStick", kExport, kMeshes, true, kStick},
        FailingCall{"ExportWithoutProc", kExport, kMeshes, true, "proc"},
        FailingCall{"ExportEndedByASignal", kExport, kMeshes, true, kStick, SIGTERM},
        FailingCall{"ExportOfTheSection", kSection, kDrawings},
        FailingCall{"ExportOfTheSectionOverOldFiles", kSection, kDrawings, true},
        FailingCall{"RepairEndedByCtrlC", kRepair, {"a.stl"}, true, {}, SIGINT},
        FailingCall{"RepairToAStickEndedByCtrlC", kRepair, {"a.stl"}, true, kStick, SIGINT},
        FailingCall{"DecimationEndedByCtrlC", kDecimate, {"a.stl"}, false, kStick, SIGINT},
        FailingCall{"ExportWithAPage", kPage, kPageFiles}, FailingCall{"Throw", kThrow, kPot},
        FailingCall{"ThrowOverOldFiles", kThrow, kPot, true},
        FailingCall{"ThrowKilled", kThrow, kPot, true, kStick, SIGKILL},
        FailingCall{"ThrowOnAPot", kCopy, {"a.pot.cbor"}, true},
        FailingCall{"Strokes", kStrokes, {"a.session"}, true},
        FailingCall{"StrokesToAStick", kStrokes, {"a.session"}, true, kStick, SIGTERM},
#ifdef CLAYSTACK_WINDOW
        FailingCall{"Render", kRender, {"a.png", "a.gif"}, true},
#endif
        FailingCall{"ImportOfADrawing", kDrawing, {"a.pot.json"}, true},
        FailingCall{"ImportOfAMesh", kMesh, {"a.pot.cbor"}, true}),
    [](const auto& test) { return test.param.name; });

/// Whether the file has a whole pot.
bool has_pot(const std::string& path) {
  const auto json = nlohmann::json::parse(read_text(path), nullptr, false);
  return json.is_object() && json.value("schema", "") == "claystack-pot-1";
}

// After any fault in a throw by hand there is a pot: the new one, also beside the planned place, or
// the old one if the throw did not begin.
TEST(WriteFaultsOfAThrowByHand, LoseNoPotAndNoSession) {
  const Folders folders;
  const std::string by_hand = "throw -q " + sample("cylinder.scene.json") +
                              " --device simulated --seconds 0.2 --record #/s.session -o "
                              "#/a.pot.json";
  const Files before{{"a.pot.json", "old pot"}, {"s.session", "old session"}};
  folders.fail_each_call(by_hand, before, {}, kFewestCalls, [&](const Ran& ran, int error) {
    const Files after = files_in(folders.out.path());
    const bool thrown = has_pot(folders.out.file("a.pot.json"));
    EXPECT_TRUE(thrown || after.at("a.pot.json") == "old pot");
    for (const auto& [name, bytes] : after) {
      const bool rescued = has_pot(folders.out.file(name)) && ran.err.find(name) < ran.err.size();
      EXPECT_TRUE(before.contains(name) || name == "s.session.recording" || rescued) << name;
    }
    EXPECT_TRUE(after.at("s.session") == "old session" ||
                after.at("s.session").starts_with("{\"schema\":\"claystack-session-1\""));
    if (ran.status == 0) {
      EXPECT_TRUE(thrown);
      return;
    }
    EXPECT_EQ(ran.status, 3);
    EXPECT_NE(ran.err.find(std::strerror(error)), std::string::npos);
    EXPECT_NE(ran.err.find(folders.out.path().string()), std::string::npos);
  });
}

TEST(WriteFaultsOfABatch, LeaveWholeResultsAndTheNextRunAddsTheRest) {
  const Folders folders;
  write_text(folders.in.file("jobs.jsonl"),
             R"({"id": "a", "run": ["plan", ")" + sample("cylinder.scene.json") + "\"]}\n" +
                 R"({"id": "b", "run": ["plan", ")" + sample("cylinder.scene.json") + "\"]}\n");
  const std::string batch = "batch -q -j 1 @/jobs.jsonl -o #/results.jsonl";
  constexpr int kFewest = 2;  // it appends
  folders.fail_each_call(batch, {}, {}, kFewest, [&](const Ran& ran, int error) {
    const std::string results = read_text(folders.out.file("results.jsonl"));
    EXPECT_TRUE(results.empty() || results.ends_with('\n')) << results;
    if (ran.status != 0) {
      EXPECT_EQ(ran.status, 3);
      EXPECT_NE(ran.err.find(std::strerror(error)), std::string::npos);
      EXPECT_NE(ran.err.find(folders.out.file("results.jsonl")), std::string::npos);
    }
    ASSERT_EQ(folders.run(batch).status, 0);
    const std::string all = read_text(folders.out.file("results.jsonl"));
    EXPECT_EQ(std::ranges::count(all, '\n'), 2) << all;
  });
}

#ifdef CLAYSTACK_STUDIO
TEST(WriteFaultsOfAWindow, LeaveTheOldFileOrTheNewOne) {
  const Folders folders;
  write_text(folders.in.file("save.script"), "open \"" + sample("cylinder.scene.json") +
                                                 "\"\nwait 0.1\nsave \"" +
                                                 folders.out.file("a.work") + "\"\n");
  const std::string window = "studio --script @/save.script --screenshot #/a.png --size 320x240";
  const Files before{{"a.work", "old work"}, {"a.png", "old picture"}};
  folders.reset(before);
  ASSERT_EQ(folders.run(window).status, 0);
  const Files whole = files_in(folders.out.path());
  folders.fail_each_call(window, before, {}, kFewestCalls, [&](const Ran& ran, int error) {
    const Files after = files_in(folders.out.path());
    EXPECT_EQ(after.size(), 2u);
    bool new_files = true;
    for (const auto& [name, bytes] : before) {
      const bool is_new = after.at(name) == whole.at(name);
      EXPECT_TRUE(is_new || after.at(name) == bytes) << name;
      new_files = new_files && is_new;
    }
    EXPECT_EQ(ran.status == 0, new_files) << ran.status;
    EXPECT_TRUE(new_files || ran.err.find(std::strerror(error)) != std::string::npos);
  });
}
#endif

TEST(WriteLimits, ReportsAFileAboveItsSizeLimit) {
  const ScratchFolder folder;
  const std::string pot = folder.file("a.pot.json"), stl = folder.file("a.stl");
  ASSERT_EQ(claystack("import -q " + sample("drawings/tumbler.csv") + " -o " + pot).status, 0);
  // In blocks of 512 bytes. Without a handler the signal SIGXFSZ ends the program.
  const Ran ran = shell("ulimit -f 8; " CLAYSTACK_PROGRAM " export -q " + pot + " " + stl);
  EXPECT_EQ(ran.status, 3) << ran.err;
  EXPECT_NE(ran.err.find(stl + ": could not write"), std::string::npos) << ran.err;
  EXPECT_EQ(files_in(folder.path()).size(), 1u);
}

}  // namespace
}  // namespace clay::test
