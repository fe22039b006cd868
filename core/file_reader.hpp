#pragma once
// Sequential reading of files that are too large for memory.

#include "claystack/core/result.hpp"
#include "core/system_calls.hpp"

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>

namespace clay {

/// A file open for reading. Errors are of kind `io`; they name the file and the system's reason.
class FileReader {
 public:
  static Result<FileReader> open(const std::filesystem::path& path);

  /// Empty for pipes and devices.
  [[nodiscard]] std::optional<std::uint64_t> size() const noexcept { return size_; }
  /// Fills `part` from its start; returns the number of bytes, 0 only at the end of the file.
  Result<std::size_t> read(std::span<char> part);
  [[nodiscard]] const std::filesystem::path& path() const noexcept { return path_; }

 private:
  FileReader(std::filesystem::path path, Descriptor descriptor);

  std::filesystem::path path_;
  Descriptor descriptor_;
  std::optional<std::uint64_t> size_;
};

/// The complete lines of a file, one at a time: one line and a block are in memory.
class FileLines {
 public:
  /// A line of more than `most_bytes` is an error of kind `io`.
  FileLines(FileReader file, std::size_t most_bytes)
      : file_(std::move(file)), most_bytes_(most_bytes) {}

  /// Without its newline, valid until the next call; empty at the end, and for a last line without
  /// its newline.
  Result<std::optional<std::string_view>> next();
  /// At the end: the last line, if it has no newline.
  [[nodiscard]] std::string_view rest() const noexcept;
  /// Of lines so far.
  [[nodiscard]] std::size_t number() const noexcept { return number_; }
  /// At the end: those of the file.
  [[nodiscard]] std::uint64_t bytes() const noexcept { return bytes_; }

 private:
  FileReader file_;
  std::size_t most_bytes_;
  std::string buffer_;
  std::size_t begin_ = 0;  ///< of the next line in the buffer
  std::size_t number_ = 0;
  std::uint64_t bytes_ = 0;
};

}  // namespace clay
