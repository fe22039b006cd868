// Every write call of a command fails once, or is where the program is killed (fault_shim.cpp):
// either all outputs exist or none, and no other files.

#include "tests/support/run_program.hpp"

#include <gtest/gtest.h>

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

struct FailingCall {
  std::string name;
  std::string arguments;  ///< @ is the input folder, # the output folder
  std::vector<std::string> outputs;
  bool replaces = false;     ///< files of these names exist before
  std::string without = {};  ///< as CLAYSTACK_FAULT_WITHOUT
  int signal = 0;            ///< instead of an error
};

void PrintTo(const FailingCall& c, std::ostream* out) { *out << c.name; }

class WriteFaults : public testing::TestWithParam<FailingCall> {
 protected:
  void SetUp() override {
    const std::string session = read_text(sample("cylinder.session"));
    const std::size_t header = session.find('\n') + 1;
    write_text(inputs.file("a.session"), session.substr(0, session.find('\n', header) + 1));
    write_text(inputs.file("a.scene.json"), read_text(sample("cylinder.scene.json")));
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

  void reset_folder() const {
    for (const auto& entry : fs::directory_iterator(folder.path())) fs::remove(entry.path());
    for (const auto& [name, bytes] : before) write_text(folder.file(name), bytes);
  }

  /// `at` 0: without a fault.
  [[nodiscard]] Ran run(int at, int error) const {
    fs::remove(log());
    std::string line = "env ASAN_OPTIONS=verify_asan_link_order=0 LD_PRELOAD=" CLAYSTACK_FAULT_SHIM;
    const auto set = [&](const std::string& name, const std::string& value) {
      line += " CLAYSTACK_FAULT_" + name + "=" + value;
    };
    set("FOLDER", folder.path().string());
    set("AT", std::to_string(at));
    set("ERRNO", std::to_string(error));
    set("SIGNAL", std::to_string(GetParam().signal));
    set("LOG", log());
    set("WITHOUT", GetParam().without);
    line += " " CLAYSTACK_PROGRAM " ";
    for (const char c : GetParam().arguments)
      line += c == '@'   ? inputs.path().string()
              : c == '#' ? folder.path().string()
                         : std::string(1, c);
    return shell(line);
  }

  [[nodiscard]] std::string log() const { return inputs.file("log"); }

  void expect_names_a_file(const std::string& message, int error) const {
    bool named = false;
    for (const std::string& name : GetParam().outputs)
      named = named || message.find(folder.file(name)) != std::string::npos;
    EXPECT_TRUE(named) << message;
    EXPECT_NE(message.find(std::strerror(error)), std::string::npos) << message;
  }

  ScratchFolder inputs, folder;
  Files before, whole;
};

TEST_P(WriteFaults, WriteAllOrNothing) {
  reset_folder();
  ASSERT_EQ(run(0, 0).status, 0);
  whole = files_in(folder.path());
  ASSERT_EQ(whole.size(), GetParam().outputs.size());

  constexpr int kErrors[] = {ENOSPC, EIO, EROFS};
  constexpr int kFewestCalls = 5, kMostCalls = 300;
  for (int at = 1;; ++at) {
    ASSERT_LT(at, kMostCalls);
    const int error = kErrors[at % 3];
    reset_folder();
    const Ran ran = run(at, error);
    const std::string call = read_text(log());
    if (call.empty()) {
      EXPECT_GT(at, kFewestCalls);
      EXPECT_EQ(ran.status, 0) << ran.err;
      break;
    }
    SCOPED_TRACE(call + ", call " + std::to_string(at) + ": " + std::strerror(error));
    if (GetParam().signal == SIGKILL) {  // the next writer finds the leftovers
      ASSERT_EQ(run(0, 0).status, 0);
      EXPECT_TRUE(files_in(folder.path()) == whole);
      continue;
    }
    const Files after = files_in(folder.path());
    if (GetParam().signal != 0) {
      EXPECT_EQ(ran.status, 128 + GetParam().signal) << ran.err;
      EXPECT_TRUE(after == before || after == whole);
    } else if (ran.status == 0) {
      EXPECT_TRUE(after == whole);
    } else {
      EXPECT_EQ(ran.status, 3) << ran.err;
      EXPECT_TRUE(after == before);
      expect_names_a_file(ran.err, error);
    }
    if (HasFailure())
      for (const auto& [name, bytes] : after) ADD_FAILURE() << name << ": " << bytes.size();
  }
}

// What is written again has the same bytes, apart from the times in reports.
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
        FailingCall{"ThrowKilled", kThrow, kPot, true, kStick, SIGKILL}),
    [](const auto& test) { return test.param.name; });

TEST(WriteLimits, ReportsAFileAboveItsSizeLimit) {
  const ScratchFolder folder;
  const std::string pot = folder.file("a.pot.json"), stl = folder.file("a.stl");
  ASSERT_EQ(claystack("import -q " + sample("drawings/tumbler.csv") + " -o " + pot).status, 0);
  // In blocks of 512 bytes. Without a handler the signal SIGXFSZ ends the program.
  const Ran ran = shell("ulimit -f 8; " CLAYSTACK_PROGRAM " export -q " + pot + " " + stl);
  EXPECT_EQ(ran.status, 3) << ran.err;
  EXPECT_NE(ran.err.find(stl + ": cannot write"), std::string::npos) << ran.err;
  EXPECT_EQ(files_in(folder.path()).size(), 1u);
}

}  // namespace
}  // namespace clay::test
