#pragma once
// Reading a file from front to back, where it is too large to be held in memory.

#include "claystack/core/result.hpp"

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <span>

namespace clay {

/// A file that is open for reading. Errors are of kind `io`; they name the file and the system's
/// reason.
class FileReader {
 public:
  static Result<FileReader> open(const std::filesystem::path& path);
  FileReader(FileReader&& other) noexcept;
  FileReader& operator=(FileReader&&) = delete;
  ~FileReader();

  /// Nothing for pipes and devices.
  [[nodiscard]] std::optional<std::uint64_t> size() const noexcept { return size_; }
  /// Fills `part` from its begin; returns how many bytes, 0 at the end of the file only.
  Result<std::size_t> read(std::span<char> part);

 private:
  FileReader(std::filesystem::path path, int descriptor);

  std::filesystem::path path_;
  int descriptor_;
  std::optional<std::uint64_t> size_;
};

}  // namespace clay
