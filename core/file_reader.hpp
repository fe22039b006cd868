#pragma once
// Sequential reading of files that are too large for memory.

#include "claystack/core/result.hpp"

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <span>

namespace clay {

/// A file open for reading. Errors are of kind `io`; they name the file and the system's reason.
class FileReader {
 public:
  static Result<FileReader> open(const std::filesystem::path& path);
  FileReader(FileReader&& other) noexcept;
  FileReader& operator=(FileReader&&) = delete;
  ~FileReader();

  /// Empty for pipes and devices.
  [[nodiscard]] std::optional<std::uint64_t> size() const noexcept { return size_; }
  /// Fills `part` from its start; returns the number of bytes, 0 only at the end of the file.
  Result<std::size_t> read(std::span<char> part);

 private:
  FileReader(std::filesystem::path path, int descriptor);

  std::filesystem::path path_;
  int descriptor_;
  std::optional<std::uint64_t> size_;
};

}  // namespace clay
