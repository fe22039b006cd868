#pragma once
// A file in use by this program.

#include <chrono>
#include <filesystem>

namespace clay::history {

/// An advisory lock (flock) on an existing regular file, until destruction. A pipe or device of
/// that name is not locked; opening it does not block.
class FileLock {
 public:
  enum class Kind { shared, exclusive };
  FileLock(const std::filesystem::path& path, Kind kind);
  ~FileLock();
  FileLock(const FileLock&) = delete;
  FileLock& operator=(const FileLock&) = delete;

  [[nodiscard]] bool opened() const noexcept { return descriptor_ >= 0; }
  [[nodiscard]] bool held() const noexcept { return held_; }
  /// Another program holds it. False where the file system has no locks.
  [[nodiscard]] bool in_use() const noexcept { return in_use_; }
  /// Time of the last change of the file.
  [[nodiscard]] std::chrono::system_clock::time_point written() const noexcept;

 private:
  int descriptor_;
  bool held_ = false, in_use_ = false;
};

}  // namespace clay::history
