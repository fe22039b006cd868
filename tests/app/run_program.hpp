#pragma once
// Runs programs as a shell would, and keeps what they print.

#include <nlohmann/json.hpp>

#include <filesystem>
#include <string>

namespace clay::test {

struct Ran {
  int status = -1;  ///< exit status; 128 + signal when killed
  std::string out;
  std::string err;
  [[nodiscard]] nlohmann::json json() const { return nlohmann::json::parse(out); }
};

/// Runs a command line through the shell, with a limit of five minutes.
Ran shell(const std::string& command);

/// Runs claystack with these arguments.
Ran claystack(const std::string& arguments);

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

}  // namespace clay::test
