#pragma once
// A folder for published files, and its contents.

#include "claystack/core/atomic_file.hpp"

#include <gtest/gtest.h>

#include <sys/stat.h>
#include <unistd.h>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <set>
#include <string>
#include <string_view>

namespace clay::test {

inline std::string bytes_in(const std::filesystem::path& path) {
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), {}};
}

inline void put(const std::filesystem::path& path, std::string_view bytes) {
  std::ofstream(path, std::ios::binary) << bytes;
}

inline mode_t mode_of(const std::filesystem::path& path) {
  struct stat status {};
  EXPECT_EQ(::stat(path.c_str(), &status), 0);
  return status.st_mode & 07777;
}

/// A folder that is removed after the test.
class AtomicFileFolder : public ::testing::Test {
 protected:
  AtomicFileFolder() {
    std::string pattern = ::testing::TempDir() + "claystack-XXXXXX";
    folder_ = ::mkdtemp(pattern.data());
  }
  ~AtomicFileFolder() override { std::filesystem::remove_all(folder_); }

  std::set<std::string> names() const {
    std::set<std::string> names;
    for (const auto& entry : std::filesystem::directory_iterator(folder_))
      names.insert(entry.path().filename().string());
    return names;
  }

  std::filesystem::path folder_;
};

/// The message must name the file and the reason.
inline void expect_io_error(const Result<void>& result, const std::filesystem::path& path,
                            int error) {
  ASSERT_FALSE(result);
  EXPECT_EQ(result.error().kind, ErrorKind::io);
  EXPECT_NE(result.error().message.find(path.string()), std::string::npos)
      << result.error().message;
  EXPECT_NE(result.error().message.find(std::strerror(error)), std::string::npos)
      << result.error().message;
}

}  // namespace clay::test
