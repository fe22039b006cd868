#pragma once
// The bytes of a file, front to back, of which only a stretch is in memory.

#include "claystack/export/formats.hpp"

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string_view>
#include <vector>

namespace clay::solid::inline formats {

class ByteStream {
 public:
  /// So long a stretch is to be had, where the file does not end before that.
  static constexpr std::size_t kStretch = std::size_t{1} << 20;

  /// The source outlives this.
  explicit ByteStream(const ByteSource& source) : source_(source) {}

  /// All that are in memory and not taken yet.
  [[nodiscard]] std::string_view ahead() const noexcept {
    return std::string_view(buffer_.data(), end_).substr(begin_);
  }
  /// Reads on until `bytes` are ahead; false where the file ends before that or cannot be read.
  /// Views of what was ahead end here. At most kStretch.
  bool fill(std::size_t bytes);
  void take(std::size_t bytes) noexcept { begin_ += bytes; }

  /// Of the whole file, as it was when it was opened.
  [[nodiscard]] std::uint64_t size() const noexcept { return source_.size; }
  /// What stopped the reading, where that was not the end.
  [[nodiscard]] const std::optional<Error>& fault() const noexcept { return fault_; }

 private:
  const ByteSource& source_;
  std::vector<char> buffer_;
  std::size_t begin_ = 0, end_ = 0;  ///< of what is ahead, in the buffer
  bool ended_ = false;
  std::optional<Error> fault_;
};

}  // namespace clay::solid::inline formats
