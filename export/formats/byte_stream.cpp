#include "export/formats/byte_stream.hpp"

#include <algorithm>
#include <cstring>
#include <span>

namespace clay::solid::inline formats {

bool ByteStream::fill(std::size_t bytes) {
  if (end_ - begin_ >= bytes) return true;
  if (ended_) return false;
  if (buffer_.empty())
    buffer_.resize(static_cast<std::size_t>(std::min<std::uint64_t>(size() + 1, 2 * kStretch)));
  const std::string_view kept = ahead();
  std::memmove(buffer_.data(), kept.data(), kept.size());
  end_ = kept.size();
  begin_ = 0;
  while (end_ < bytes && !ended_) {
    // For a long line, or a file that has grown since it was opened.
    if (end_ == buffer_.size()) buffer_.resize(2 * std::max(buffer_.size(), kStretch));
    const auto count = source_.read(std::span(buffer_).subspan(end_));
    if (!count) fault_ = count.error();
    ended_ = !count || *count == 0;
    if (count) end_ += *count;
  }
  return end_ >= bytes;
}

}  // namespace clay::solid::inline formats
