#include "tests/support/run_program.hpp"

#include "tests/support/wait_until.hpp"

#include <fcntl.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <csignal>
#include <cstdlib>
#include <fstream>
#include <sstream>
#include <stdexcept>

namespace clay::test {
namespace {

/// Executes the command in its own process group, which ends with the test.
[[noreturn]] void become(const char* command, const std::array<int, 3>& files) {
  setpgid(0, 0);
  prctl(PR_SET_PDEATHSIG, SIGTERM);
  for (int i = 0; i < 3; ++i) dup2(files[static_cast<std::size_t>(i)], i);
  execl("/bin/sh", "sh", "-c", command, nullptr);
  _exit(127);
}

}  // namespace

Program::Program(const std::string& command) : command_(command) {
  // Opened before the fork, because between fork and exec only async-signal-safe calls are allowed.
  constexpr int kWrite = O_WRONLY | O_CREAT | O_CLOEXEC;
  const std::array<int, 3> files = {open("/dev/null", O_RDONLY | O_CLOEXEC),
                                    open(folder_.file("out").c_str(), kWrite, 0600),
                                    open(folder_.file("err").c_str(), kWrite, 0600)};
  process_ = fork();
  if (process_ == 0) become(command_.c_str(), files);
  for (const int file : files) close(file);
  if (process_ < 0) throw std::runtime_error("could not start: " + command_);
  setpgid(process_, process_);
}

Program::~Program() {
  if (!running()) return;
  kill(-process_, SIGTERM);
  try {
    wait_until([&] { return !running(); }, std::chrono::seconds(10), "the end of: " + command_);
  } catch (const std::runtime_error&) {
    kill(-process_, SIGKILL);
    waitpid(process_, nullptr, 0);
  }
}

bool Program::running() {
  int status = 0;
  if (!running_ || waitpid(process_, &status, WNOHANG) == 0) return running_;
  running_ = false;
  status_ = WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
  return false;
}

void Program::send(int signal) {
  if (running()) kill(process_, signal);
}

Ran Program::wait(std::chrono::seconds deadline) {
  try {
    wait_until([&] { return !running(); }, deadline, "the end of: " + command_);
  } catch (const std::runtime_error& late) {
    throw std::runtime_error(std::string(late.what()) + "\n" + out() + err());
  }
  return {status_, out(), err()};
}

Ran shell(const std::string& command) { return Program(command).wait(); }

Ran claystack(const std::string& arguments) {
  return shell(std::string(CLAYSTACK_PROGRAM).append(" ").append(arguments));
}

ScratchFolder::ScratchFolder() {
  std::string pattern = (std::filesystem::temp_directory_path() / "claystack-XXXXXX").string();
  if (!mkdtemp(pattern.data())) throw std::runtime_error("no scratch folder: " + pattern);
  path_ = pattern;
}

ScratchFolder::~ScratchFolder() {
  std::error_code ignored;
  std::filesystem::remove_all(path_, ignored);
}

std::string read_text(const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  std::stringstream text;
  text << file.rdbuf();
  return text.str();
}

void write_text(const std::string& path, const std::string& text) {
  std::ofstream(path, std::ios::binary) << text;
}

std::string sample(const std::string& name) {
  return std::string(CLAYSTACK_SAMPLES).append("/").append(name);
}

}  // namespace clay::test
