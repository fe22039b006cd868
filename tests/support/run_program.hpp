#pragma once
// Runs programs through a shell, and captures their output.

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

/// Far above the needs of the programs; below CTest's limit for a test.
inline constexpr std::chrono::seconds kProgramDeadline{240};

/// A folder that is removed after the test.
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

/// A command line that runs in parallel with the test, and ends with it at the latest.
class Program {
 public:
  /// Through the shell. `exec` before a program's name makes signals reach that program.
  explicit Program(const std::string& command);
  ~Program();
  Program(const Program&) = delete;
  Program& operator=(const Program&) = delete;

  [[nodiscard]] bool running();
  /// Sends a signal to the running program.
  void send(int signal);
  /// The output so far.
  [[nodiscard]] std::string out() const { return read_text(folder_.file("out")); }
  [[nodiscard]] std::string err() const { return read_text(folder_.file("err")); }
  /// Waits for its end; throws after the deadline.
  Ran wait(std::chrono::seconds deadline = kProgramDeadline);

 private:
  std::string command_;
  ScratchFolder folder_;  // for its output
  pid_t process_ = -1;    // leader of its process group
  int status_ = -1;       // as Ran's
  bool running_ = true;
};

}  // namespace clay::test
