#include "core/file_reader.hpp"

#include <sys/stat.h>

#include <algorithm>
#include <utility>

namespace clay {
namespace fs = std::filesystem;

FileReader::FileReader(fs::path path, Descriptor descriptor)
    : path_(std::move(path)), descriptor_(std::move(descriptor)) {}

Result<FileReader> FileReader::open(const fs::path& path) {
  Descriptor descriptor(open_retrying(path, O_RDONLY));
  if (descriptor.get() == -1) return io_failure(path, "could not open");
  struct stat status {};
  if (::fstat(descriptor.get(), &status) == -1) return io_failure(path, "could not read");
  if (S_ISDIR(status.st_mode))
    return failure(ErrorKind::io, path.string() + ": expected a file, found a folder");
  FileReader file(path, std::move(descriptor));
  if (S_ISREG(status.st_mode)) file.size_ = static_cast<std::uint64_t>(status.st_size);
  return file;
}

Result<std::size_t> FileReader::read(std::span<char> part) {
  const auto count =
      uninterrupted([&] { return ::read(descriptor_.get(), part.data(), part.size()); });
  if (count < 0) return io_failure(path_, "could not read");
  return static_cast<std::size_t>(count);
}

Result<std::optional<std::string_view>> FileLines::next() {
  constexpr std::size_t kBlock = std::size_t{1} << 16;
  std::size_t searched = begin_;
  for (;;) {
    const auto newline = buffer_.find('\n', searched);
    if (std::min(newline, buffer_.size()) - begin_ > most_bytes_)
      return failure(ErrorKind::io, file_.path().string() + ":" + std::to_string(number_ + 1) +
                                        ": expected a line of at most " +
                                        std::to_string(most_bytes_) + " bytes, found a longer one");
    if (newline != std::string::npos) {
      const auto line = std::string_view(buffer_).substr(begin_, newline - begin_);
      begin_ = newline + 1;
      ++number_;
      return line;
    }
    buffer_.erase(0, std::exchange(begin_, 0));
    searched = buffer_.size();
    buffer_.resize(searched + kBlock);
    const auto count = file_.read(std::span(buffer_).subspan(searched));
    buffer_.resize(searched + count.value_or(0));
    if (!count) return tl::make_unexpected(count.error());
    if (*count == 0) return std::nullopt;
    bytes_ += *count;
  }
}

std::string_view FileLines::rest() const noexcept {
  return std::string_view(buffer_).substr(begin_);
}

}  // namespace clay
