#include "app/servo/session_recording.hpp"

#include "claystack/core/atomic_file.hpp"
#include "claystack/engine/files.hpp"
#include "core/system_calls.hpp"

#include <fcntl.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <utility>

namespace clay::servo {
namespace {

namespace fs = std::filesystem;

}  // namespace

Result<std::unique_ptr<SessionRecording>> SessionRecording::begin(const std::string& path,
                                                                  std::string_view scene_name,
                                                                  std::uint64_t scene_hash) {
  std::unique_ptr<SessionRecording> recording(new SessionRecording(path));
  struct stat status {};
  const bool exists = stat(path.c_str(), &status) == 0;
  if (!exists && errno != ENOENT) return recording->failed("open");
  if ((exists && S_ISDIR(status.st_mode)) || !fs::path(path).has_filename())
    return failure(ErrorKind::io, path + ": expected the name of a file, found a folder");
  // The old session is not opened for writing, so its write permission is checked here: a rename
  // would ignore it.
  if (exists && access(path.c_str(), W_OK) != 0) return recording->failed("open");
  const bool replaceable = !exists || S_ISREG(status.st_mode);
  auto begun = replaceable ? recording->open_aside() : recording->open_in_place();
  if (begun && exists && replaceable && fchmod(recording->descriptor_, status.st_mode & 07777) != 0)
    return recording->failed("keep the mode");
  if (begun) begun = recording->write(session_header(scene_name, scene_hash));
  if (!begun) return tl::make_unexpected(begun.error());
  return recording;
}

SessionRecording::~SessionRecording() {
  if (poses_ == 0) discard();
  if (descriptor_ >= 0) (void)close(descriptor_);
}

Result<void> SessionRecording::open_in_place() {
  descriptor_ = open(path_.c_str(), O_WRONLY | O_NOCTTY | O_CLOEXEC);
  if (descriptor_ < 0) return failed("open");
  return {};
}

Result<void> SessionRecording::open_aside() {
  std::error_code none;
  const fs::path real = fs::canonical(path_, none);
  target_ = none ? fs::path(path_) : real;
  aside_ = target_.string() + ".recording";
  return lock_aside().and_then([&] { return clear_aside(); });
}

Result<void> SessionRecording::lock_aside() {
  for (;;) {
    descriptor_ = open(aside_.c_str(), O_RDWR | O_CREAT | O_APPEND | O_CLOEXEC, 0666);
    if (descriptor_ < 0) return failed("open");
    if (flock(descriptor_, LOCK_EX | LOCK_NB) != 0) {
      const bool taken = errno == EWOULDBLOCK;
      return taken ? failure(ErrorKind::io, path_ + ": another program is recording to it")
                   : failed("lock");
    }
    struct stat locked {
    }, named{};
    if (fstat(descriptor_, &locked) == 0 && stat(aside_.c_str(), &named) == 0 &&
        same_file(locked, named))
      return {};
    // The other program finished between open and lock, so this file is now its session.
    (void)close(std::exchange(descriptor_, -1));
  }
}

/// Removes the recording of a program that died before its first pose; keeps one with poses.
Result<void> SessionRecording::clear_aside() {
  struct stat status {};
  if (fstat(descriptor_, &status) != 0) return failed("read");
  owns_aside_ = status.st_size == 0;
  if (owns_aside_) return {};
  const std::string name = aside_.string();
  const auto left = read_file(aside_).and_then(
      [&](const std::string& text) { return parse_session(text, name); });
  if (!left || !left->poses.empty())
    return failure(ErrorKind::io, name +
                                      ": holds an unfinished recording; play it with "
                                      "--session, then rename or remove it");
  if (ftruncate(descriptor_, 0) != 0) return failed("shorten");
  owns_aside_ = true;
  return {};
}

Result<void> SessionRecording::append(const PoseBlock& block) {
  poses_ += block.poses.size();
  return write(session_block(block.poses));
}

Result<void> SessionRecording::write(std::string_view text) {
  if (!write_all(descriptor_, text)) return failed("write");
  return {};
}

Result<void> SessionRecording::finish() {
  if (poses_ == 0) {
    discard();
    return {};
  }
  const int synced = uninterrupted([&] { return fsync(descriptor_); });
  if (synced != 0 && (!aside_.empty() || errno != EINVAL)) return failed("sync");
  if (aside_.empty()) return {};
  // Renamed while it is still locked, so that no other program treats it as unfinished.
  if (rename(aside_.c_str(), target_.c_str()) != 0) return failed("replace");
  owns_aside_ = false;
  const fs::path folder = target_.parent_path();
  sync_folder(folder.empty() ? fs::path(".") : folder);
  return {};
}

void SessionRecording::discard() noexcept {
  if (std::exchange(owns_aside_, false)) (void)unlink(aside_.c_str());
}

/// Describes `errno`.
tl::unexpected<Error> SessionRecording::failed(const char* action) const {
  std::string message = io_failure(path_, std::string("could not ") + action).value().message;
  if (poses_ > 0 && !aside_.empty()) message += "; the recording is in " + aside_.string();
  return failure(ErrorKind::io, std::move(message));
}

}  // namespace clay::servo
