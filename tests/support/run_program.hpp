#pragma once
// Runs programs as a shell would, and keeps what they print.

#include <sys/types.h>
#include <nlohmann/json.hpp>

#include <chrono>
#include <filesystem>
#include <string>

namespace clay::test {

struct Ran {
  int status = -1;  ///< exit status; 128 + signal when killed
  std::string out;
  std::string err;
  [[nodiscard]] nlohmann::json json() const { return nlohmann::json::parse(out); }
};

/// Runs a command line through the shell, with a limit of kProgramDeadline.
Ran shell(const std::string& command);

/// Runs claystack with these arguments.
Ran claystack(const std::string& arguments);

/// What most programs never need; shorter than CTest's limit for a test.
inline constexpr std::chrono::seconds kProgramDeadline{240};

/// A folder that is gone after the test.
class ScratchFolder {
 public:
  ScratchFolder();
  ~ScratchFolder();
  ScratchFolder(const ScratchFolder&) = delete;
  ScratchFolder& operator=(const ScratchFolder&) = delete;
  [[nodiscard]] std::string file(const std::string& name) const { return (path_ / name).string(); }
  [[nodiscard]] const std::filesystem::path& path() const { return path_; }

 private:
  std::filesystem::path path_;
};

std::string read_text(const std::string& path);
void write_text(const std::string& path, const std::string& text);
[[nodiscard]] std::string sample(const std::string& name);

/// A command line that runs beside the test, and ends with it at the latest.
class Program {
 public:
  /// Through the shell. `exec` before a program's name makes signals reach that program.
  explicit Program(const std::string& command);
  ~Program();
  Program(const Program&) = delete;
  Program& operator=(const Program&) = delete;

  [[nodiscard]] bool running();
  /// To a program that is still running.
  void send(int signal);
  /// What it has printed so far.
  [[nodiscard]] std::string out() const { return read_text(folder_.file("out")); }
  [[nodiscard]] std::string err() const { return read_text(folder_.file("err")); }
  /// Waits for its end; throws after the deadline.
  Ran wait(std::chrono::seconds deadline = kProgramDeadline);

 private:
  std::string command_;
  ScratchFolder folder_;  // what it prints
  pid_t process_ = -1;    // leads a group of its own
  int status_ = -1;       // as Ran's
  bool running_ = true;
};

}  // namespace clay::test
