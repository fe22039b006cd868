#include "app/history/file_lock.hpp"

#include <fcntl.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>

namespace clay::history {

FileLock::FileLock(const std::filesystem::path& path, Kind kind)
    : descriptor_(open(path.c_str(), O_RDONLY | O_CLOEXEC | O_NONBLOCK | O_NOCTTY)) {
  struct stat status {};
  const bool regular =
      descriptor_ >= 0 && fstat(descriptor_, &status) == 0 && S_ISREG(status.st_mode);
  if (!regular) return;
  held_ = flock(descriptor_, (kind == Kind::shared ? LOCK_SH : LOCK_EX) | LOCK_NB) == 0;
  in_use_ = !held_ && errno == EWOULDBLOCK;
}

FileLock::~FileLock() {
  if (descriptor_ >= 0) (void)close(descriptor_);
}

std::chrono::system_clock::time_point FileLock::written() const noexcept {
  struct stat status {};
  (void)fstat(descriptor_, &status);
  return std::chrono::system_clock::from_time_t(status.st_mtime);
}

}  // namespace clay::history
