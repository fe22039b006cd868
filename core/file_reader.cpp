#include "core/file_reader.hpp"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>
#include <cerrno>
#include <system_error>
#include <utility>

namespace clay {
namespace fs = std::filesystem;
namespace {

/// Uses `errno`, so call it before anything can change that.
tl::unexpected<Error> io_failure(const fs::path& path, const char* what) {
  const std::string cause = std::error_code(errno, std::system_category()).message();
  return failure(ErrorKind::io, path.string() + ": " + what + ": " + cause);
}

}  // namespace

FileReader::FileReader(fs::path path, int descriptor)
    : path_(std::move(path)), descriptor_(descriptor) {}

FileReader::FileReader(FileReader&& other) noexcept
    : path_(std::move(other.path_)),
      descriptor_(std::exchange(other.descriptor_, -1)),
      size_(other.size_) {}

FileReader::~FileReader() {
  if (descriptor_ != -1) ::close(descriptor_);
}

Result<FileReader> FileReader::open(const fs::path& path) {
  int descriptor = -1;
  do {
    descriptor = ::open(path.c_str(), O_RDONLY | O_CLOEXEC);
  } while (descriptor == -1 && errno == EINTR);
  if (descriptor == -1) return io_failure(path, "cannot open");
  FileReader file(path, descriptor);
  struct stat status {};
  if (::fstat(descriptor, &status) == -1) return io_failure(path, "cannot read");
  if (S_ISDIR(status.st_mode))
    return failure(ErrorKind::io, path.string() + ": expected a file, found a folder");
  if (S_ISREG(status.st_mode)) file.size_ = static_cast<std::uint64_t>(status.st_size);
  return file;
}

Result<std::size_t> FileReader::read(std::span<char> part) {
  for (;;) {
    const auto count = ::read(descriptor_, part.data(), part.size());
    if (count >= 0) return static_cast<std::size_t>(count);
    if (errno != EINTR) return io_failure(path_, "cannot read");
  }
}

}  // namespace clay
