#pragma once
// Independent programs that check the written files.

#include <gtest/gtest.h>

#include <unistd.h>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <string>
#include <string_view>

namespace clay::solid::samples {

/// A file in the temporary folder that is removed at the end of the scope.
class ScratchFile {
 public:
  explicit ScratchFile(std::string_view ending, std::string_view bytes = {})
      : path_(std::filesystem::temp_directory_path() /
              ("claystack_" + std::to_string(getpid()) + "_" + std::to_string(++count_) +
               std::string(ending))) {
    EXPECT_TRUE((std::ofstream(path_, std::ios::binary) << bytes).flush()) << path_;
  }
  ScratchFile(const ScratchFile&) = delete;
  ScratchFile& operator=(const ScratchFile&) = delete;
  ~ScratchFile() { std::filesystem::remove(path_); }

  [[nodiscard]] std::string path() const { return path_.string(); }

 private:
  static inline int count_ = 0;
  std::filesystem::path path_;
};

/// The output of a command; fails the test unless it ends well within 20 s.
inline std::string output_of(const std::string& command) {
  std::FILE* const pipe = popen(("timeout 20 " + command + " 2>&1").c_str(), "r");
  if (pipe == nullptr) return {};
  std::string text;
  char part[4096];
  for (std::size_t n = 0; (n = std::fread(part, 1, sizeof part, pipe)) > 0;) text.append(part, n);
  EXPECT_EQ(pclose(pipe), 0) << command << "\n" << text;
  return text;
}

}  // namespace clay::solid::samples
