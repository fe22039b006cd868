// Every command with closed or full standard streams.

#include "tests/support/run_program.hpp"

#include <gtest/gtest.h>

#include <filesystem>
#include <string>
#include <vector>

namespace clay::test {
namespace {

struct Command {
  std::string arguments;
  int status;          ///< if all streams are writable
  bool prints;         ///< to standard output
  bool reads = false;  ///< standard input
};

struct Streams {
  const char* redirection;
  bool input, output;  ///< readable, writable
};

constexpr Streams kStreams[] = {
    {"", true, true},
    {">&-", true, false},
    {"2>&-", true, true},
    {"<&-", false, true},
    {">&- 2>&-", true, false},
    {"<&- >&- 2>&-", false, false},
    {">/dev/full", true, false},
    {"2>/dev/full", true, true},
    {">/dev/full 2>/dev/full", true, false},
};

class StandardStreams : public testing::Test {
 protected:
  void SetUp() override {
    ASSERT_EQ(claystack("throw -q " + bowl_ + " -o " + pot_).status, 0);
    write_text(folder_.file("bad.pot.json"), "{");
    write_text(folder_.file("outline.csv"), "30,0\n40,60\n");
  }

  [[nodiscard]] std::vector<Command> commands() const {
    const std::string bad = folder_.file("bad.pot.json"), out = folder_.file("out");
    return {
        {"", 2, false},
        {"--help", 0, true},
        {"--version", 0, true},
        {"knead", 2, false},
        {"throw --help", 0, true},
        {"throw --unknown", 2, false},
        {"throw " + bowl_, 0, true},
        {"throw -q " + bowl_ + " -o " + out + ".pot.json", 0, false},
        {"throw --json " + bowl_, 0, true},
        {"throw " + bowl_ + " -o " + out + "/none.pot.json", 3, false},
        {"throw - -s " + sample("bowl.session"), 0, true, true},
        {"throw " + folder_.file("none.scene.json"), 3, false},
        {"plan " + bowl_, 0, true},
        {"plan " + bad, 2, false},
#ifdef CLAYSTACK_FALCON
        {"throw " + bowl_ + " --device simulated --seconds 0.2", 0, true},
        {"throw " + bowl_ + " --device simulated --seconds 0.2 -q", 0, false},
        {"throw " + bowl_ + " --device hand", 2, false},
#endif
#ifdef CLAYSTACK_USB
        {"devices --help", 0, true},
        {"devices simulated --monitor --seconds 0.3", 0, true},
        {"devices /dev/hidraw99", 4, false},
#endif
        {"export " + pot_ + " " + out + ".stl", 0, true},
        {"export -q " + pot_ + " " + out + ".stl", 0, false},
        {"export " + bad + " " + out + ".stl", 2, false},
        {"check " + pot_, 0, true},
        {"check " + bad, 2, false},
#ifdef CLAYSTACK_DRAWINGS
        {"import " + folder_.file("outline.csv") + " --wall 4 -o " + out + ".pot.json", 0, true},
        {"import " + bad + " -o " + out + ".pot.json", 2, false},
#endif
#ifdef CLAYSTACK_WINDOW
        {"render " + pot_ + " --size 64x64 -o " + out + ".png", 0, true},
        {"render " + bad + " -o " + out + ".png", 2, false},
#endif
#ifdef CLAYSTACK_STUDIO
        {"studio --help", 0, true},
        {"studio --unknown", 2, false},
        {"studio", 4, false},
#endif
    };
  }

  const ScratchFolder folder_;
  const std::string bowl_ = sample("bowl.scene.json");
  const std::string pot_ = folder_.file("bowl.pot.json");
};

TEST_F(StandardStreams, ClosedOrFullStreamsAffectOnlyTheirOwnText) {
  const std::string alone =
      "env -u DISPLAY -u WAYLAND_DISPLAY XDG_CONFIG_HOME=" + folder_.file("") +
      " timeout -s KILL 60 " CLAYSTACK_PROGRAM " ";
  for (const Command& command : commands())
    for (const Streams& streams : kStreams) {
      const int expected = (command.reads && !streams.input) || (command.prints && !streams.output)
                               ? 3
                               : command.status;
      const std::string from = command.reads && streams.input ? " <" + bowl_ : "";
      const auto run = shell(alone + command.arguments + from + " " + streams.redirection);
      EXPECT_EQ(run.status, expected) << command.arguments << " " << streams.redirection << "\n"
                                      << run.err;
    }
}

TEST_F(StandardStreams, NeverWritesAClosedStreamsTextToAFile) {
  const std::string pot = folder_.file("b.pot.json"), trace = folder_.file("trace.csv");
  EXPECT_EQ(claystack("throw " + bowl_ + " -o " + pot + " --trace " + trace + " >&- 2>&-").status,
            3);
  EXPECT_EQ(read_text(pot), read_text(pot_));
  EXPECT_EQ(read_text(trace).find("claystack"), std::string::npos);
}

#ifdef CLAYSTACK_USB
TEST_F(StandardStreams, RefusesToMonitorWithClosedStdout) {
  const auto run =
      shell("timeout -s KILL 60 " CLAYSTACK_PROGRAM " devices simulated --monitor >/dev/full");
  EXPECT_EQ(run.status, 3) << run.err;
}
#endif

/// Runs claystack under a shell limit. The output goes through a pipe, because the limit may apply
/// to files.
std::string limited(const std::string& limit, const std::string& arguments) {
  return shell("(ulimit " + limit + "; " CLAYSTACK_PROGRAM " " + arguments +
               "; echo status $?) 2>&1 | cat")
      .out;
}

TEST_F(StandardStreams, ReportsAFileSizeLimit) {
  const std::string out = folder_.file("out.pot.json");
  EXPECT_EQ(limited("-f 0", "throw -q " + bowl_ + " -o " + out),
            "claystack: " + out + ": could not write: File too large\nstatus 3\n");
  EXPECT_FALSE(std::filesystem::exists(out));
}

TEST_F(StandardStreams, RunsWithADozenDescriptors) {
  EXPECT_EQ(limited("-n 16", "export -q " + pot_ + " " + folder_.file("out.stl")), "status 0\n");
}

// A sanitizer needs more addresses than the limit leaves.
#if !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__)
TEST_F(StandardStreams, RefusesAWheelBeyondTheAddressSpaceInOneLine) {
  auto scene = nlohmann::json::parse(read_text(bowl_));
  scene["lump"]["max_rings"] = 16'000'000;
  write_text(folder_.file("huge.scene.json"), scene.dump());
  const std::string said = limited(
      "-v 200000", "throw -q " + folder_.file("huge.scene.json") + " -s " + sample("bowl.session"));
  EXPECT_NE(said.find("a wheel for up to 16000000 rings needs about 0.8 GB of memory, found "),
            std::string::npos)
      << said;
  EXPECT_TRUE(said.ends_with("status 3\n")) << said;
}
#endif

}  // namespace
}  // namespace clay::test
