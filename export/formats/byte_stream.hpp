#pragma once
// Reads the bytes of a file sequentially, with only a part in memory.

#include "claystack/export/formats.hpp"

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string_view>
#include <vector>

namespace clay::solid::inline formats {

class ByteStream {
 public:
  /// A view of this length is available, unless the file ends earlier.
  static constexpr std::size_t kStretch = std::size_t{1} << 20;

  /// The source outlives this.
  explicit ByteStream(const ByteSource& source) : source_(source) {}

  /// All bytes in memory that have not been consumed.
  [[nodiscard]] std::string_view ahead() const noexcept {
    return std::string_view(buffer_.data(), end_).substr(begin_);
  }
  /// Reads on until `bytes` are available; false if the file ends before or cannot be read.
  /// Invalidates views of `ahead`.
  bool fill(std::size_t bytes);
  void take(std::size_t bytes) noexcept { begin_ += bytes; }

  /// Size of the whole file when it was opened.
  [[nodiscard]] std::uint64_t size() const noexcept { return source_.size; }
  /// The error that stopped the reading, if any.
  [[nodiscard]] const std::optional<Error>& fault() const noexcept { return fault_; }

 private:
  const ByteSource& source_;
  std::vector<char> buffer_;
  std::size_t begin_ = 0, end_ = 0;  ///< bounds of the available bytes in the buffer
  bool ended_ = false;
  std::optional<Error> fault_;
};

}  // namespace clay::solid::inline formats
