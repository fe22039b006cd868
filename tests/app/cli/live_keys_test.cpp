// Keys while throwing, with the program in a separate terminal.

#include "claystack/engine/files.hpp"
#include "tests/support/run_program.hpp"
#include "tests/support/wait_until.hpp"

#include <fcntl.h>
#include <gtest/gtest.h>
#include <poll.h>
#include <pty.h>
#include <signal.h>
#include <sys/wait.h>
#include <termios.h>
#include <unistd.h>
#include <utmp.h>

#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace clay::test {
namespace {

/// `claystack throw` with the simulated arm, in a terminal.
class InATerminal {
 public:
  explicit InATerminal(const ScratchFolder& folder) : folder_(folder) {
    EXPECT_EQ(openpty(&ours_, &theirs_, nullptr, nullptr, nullptr), 0);
    EXPECT_EQ(tcgetattr(theirs_, &before_), 0);
    const std::string scene = sample("paper/bowl.scene.json"), session = folder.file("s.session"),
                      pot = folder.file("a.pot.json");
    program_ = fork();
    if (program_ == 0) {
      alarm(static_cast<unsigned>(kProgramDeadline.count()));  // prevents an orphan
      close(ours_);
      login_tty(theirs_);
      execl(CLAYSTACK_PROGRAM, CLAYSTACK_PROGRAM, "throw", scene.c_str(), "--device", "simulated",
            "--record", session.c_str(), "-o", pot.c_str(), nullptr);
      _exit(127);
    }
  }
  ~InATerminal() {
    if (program_ > 0) kill(program_, SIGKILL), wait();
    close(ours_);
    close(theirs_);
  }
  InATerminal(const InATerminal&) = delete;
  InATerminal& operator=(const InATerminal&) = delete;

  void type(std::string_view keys) {
    ASSERT_EQ(write(ours_, keys.data(), keys.size()), static_cast<ssize_t>(keys.size()));
  }
  void send(int signal) { kill(program_, signal); }
  /// Like closing the terminal window: reading and writing fail from here on, and SIGHUP arrives.
  void hang_up() { close(std::exchange(ours_, -1)); }

  /// Whether the terminal shows this text from here on, before the program ends.
  bool shows(const std::string& text) {
    bool open = true;
    wait_until([&] { return shown_.find(text) != std::string::npos || !(open = read_on()); },
               kDeadline, "the terminal to show: " + text);
    if (!open) return false;
    shown_.erase(0, shown_.find(text) + text.size());
    return true;
  }

  /// Its wait status.
  int wait() {
    int status = 0;
    waitpid(std::exchange(program_, -1), &status, 0);
    return WIFSIGNALED(status) ? 128 + WTERMSIG(status) : WEXITSTATUS(status);
  }

  [[nodiscard]] tcflag_t modes() const {
    termios now{};
    tcgetattr(theirs_, &now);
    return now.c_lflag;
  }
  [[nodiscard]] tcflag_t modes_before() const { return before_.c_lflag; }

  [[nodiscard]] std::vector<Pose> poses() const {
    std::string path = folder_.file("s.session.recording");
    if (!std::filesystem::exists(path)) path = folder_.file("s.session");
    return parse_session(read_text(path), path).value().poses;
  }

 private:
  /// False: the program has closed the terminal.
  bool read_on() {
    pollfd output{ours_, POLLIN, 0};
    if (poll(&output, 1, 100) <= 0) return true;
    char some[4096];
    const ssize_t size = read(ours_, some, sizeof some);
    if (size > 0) shown_.append(some, static_cast<std::size_t>(size));
    return size > 0;
  }

  const ScratchFolder& folder_;
  int ours_ = -1, theirs_ = -1;
  pid_t program_ = -1;
  termios before_{};
  std::string shown_;
};

TEST(LiveKeys, KeysPauseReleaseRearmAndQuit) {
  const ScratchFolder folder;
  InATerminal terminal(folder);
  ASSERT_TRUE(terminal.shows("keys: space pauses"));
  ASSERT_TRUE(terminal.shows("force ramps up"));
  EXPECT_EQ(terminal.modes() & (ICANON | ECHO), 0u);
  EXPECT_NE(terminal.modes() & ISIG, 0u);
  terminal.type(" ");
  ASSERT_TRUE(terminal.shows("paused"));
  const std::size_t paused = terminal.poses().size();
  terminal.type(" ");
  ASSERT_TRUE(terminal.shows("force ramps up"));
  terminal.type("z");
  ASSERT_TRUE(terminal.shows("no force: it was set to zero; press r"));
  terminal.type("xr");  // one key without a function, and one with
  ASSERT_TRUE(terminal.shows("force ramps up"));
  terminal.type("q");
  ASSERT_TRUE(terminal.shows("ended: stopped"));
  EXPECT_EQ(terminal.wait(), 0);
  EXPECT_EQ(terminal.modes(), terminal.modes_before());
  // The clay does not move during a pause: a gap in time, but no poses in the record.
  EXPECT_GT(terminal.poses().size(), paused);
  EXPECT_EQ(claystack("throw -q " + sample("paper/bowl.scene.json") + " -s " +
                      folder.file("s.session") + " -o " + folder.file("b.pot.json"))
                .status,
            0);
  EXPECT_EQ(read_text(folder.file("b.pot.json")), read_text(folder.file("a.pot.json")));
}

TEST(LiveKeys, CtrlCEndsAndCtrlZIsIgnored) {
  const ScratchFolder folder;
  InATerminal terminal(folder);
  ASSERT_TRUE(terminal.shows("force ramps up"));
  terminal.type("\x1A");  // Ctrl-Z
  ASSERT_TRUE(terminal.shows("force ramps up"));
  terminal.type("\x03");  // Ctrl-C
  ASSERT_TRUE(terminal.shows("ended: stopped"));
  EXPECT_EQ(terminal.wait(), 0);
  EXPECT_EQ(terminal.modes(), terminal.modes_before());
}

TEST(LiveKeys, KeepsPotAndSessionWhenTheTerminalCloses) {
  const ScratchFolder folder;
  InATerminal terminal(folder);
  ASSERT_TRUE(terminal.shows("force ramps up"));
  terminal.hang_up();
  EXPECT_EQ(terminal.wait(), 3) << "its summary could not be printed";
  EXPECT_EQ(claystack("throw -q " + sample("paper/bowl.scene.json") + " -s " +
                      folder.file("s.session") + " -o " + folder.file("b.pot.json"))
                .status,
            0);
  EXPECT_FALSE(read_text(folder.file("a.pot.json")).empty());
  EXPECT_EQ(read_text(folder.file("b.pot.json")), read_text(folder.file("a.pot.json")));
}

TEST(LiveKeys, RestoresTheTerminalAfterEveryCatchableSignal) {
  for (const int signal : {SIGINT, SIGTERM, SIGHUP, SIGPIPE, SIGQUIT, SIGSEGV, SIGABRT}) {
    const ScratchFolder folder;
    InATerminal terminal(folder);
    ASSERT_TRUE(terminal.shows("force ramps up"));
    EXPECT_NE(terminal.modes(), terminal.modes_before());
    terminal.send(signal);
    const int ended = terminal.wait();
    EXPECT_TRUE(ended == 0 || ended == 128 + signal) << ended;
    EXPECT_EQ(terminal.modes(), terminal.modes_before()) << signal;
  }
}

}  // namespace
}  // namespace clay::test
