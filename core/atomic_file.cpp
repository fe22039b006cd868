#include "claystack/core/atomic_file.hpp"

#include "core/system_calls.hpp"
#include "core/temporary_name.hpp"

#include <sys/file.h>
#include <sys/stat.h>
#include <algorithm>
#include <array>
#include <cassert>
#include <cstdio>
#include <new>
#include <set>
#include <system_error>
#include <utility>
#include <vector>

namespace clay {
namespace fs = std::filesystem;
namespace {

tl::unexpected<Error> too_large(const fs::path& path, const std::string& found,
                                std::size_t max_bytes) {
  return failure(ErrorKind::io, path.string() + ": expected at most " + std::to_string(max_bytes) +
                                    " bytes, found " + found);
}

/// Reads to the end of the file; `expected_bytes` is a hint.
Result<std::string> read_all(int descriptor, const fs::path& path, std::size_t expected_bytes,
                             std::size_t max_bytes) {
  std::string text;
  text.reserve(expected_bytes);
  std::array<char, 65536> chunk;
  for (;;) {
    const auto count =
        uninterrupted([&] { return ::read(descriptor, chunk.data(), chunk.size()); });
    if (count < 0) return io_failure(path, "could not read");
    if (count == 0) return text;
    if (static_cast<std::size_t>(count) > max_bytes - text.size())
      return too_large(path, "more", max_bytes);
    text.append(chunk.data(), static_cast<std::size_t>(count));
  }
}

/// The /proc path of an unnamed file. Does not exist if /proc is not mounted.
fs::path name_in_proc(int descriptor) { return "/proc/self/fd/" + std::to_string(descriptor); }

/// Opens an unnamed file where the file system supports it and can name the file later, otherwise a
/// temporary one.
std::pair<int, TemporaryName> open_beside(const fs::path& target) {
  constexpr mode_t kReadWriteForAll = 0666;  // less the umask
  const int unnamed = open_retrying(folder_of(target), O_TMPFILE | O_RDWR, kReadWriteForAll);
  if (unnamed == -1) return open_temporary(target);
  if (::access(name_in_proc(unnamed).c_str(), F_OK) == 0) {
    // The lock is for later, when the file gets a temporary name. On a file system without locks
    // the file stays unlocked.
    (void)::flock(unnamed, LOCK_EX | LOCK_NB);
    return {unnamed, TemporaryName()};
  }
  ::close(unnamed);
  return open_temporary(target);
}

}  // namespace

Result<std::string> read_file(const fs::path& path, std::size_t max_bytes) {
  const Descriptor file(path == "-" ? ::dup(STDIN_FILENO) : open_retrying(path, O_RDONLY));
  if (file.get() == -1) return io_failure(path, "could not open");
  struct stat status {};
  if (::fstat(file.get(), &status) == -1) return io_failure(path, "could not read");
  if (S_ISDIR(status.st_mode))
    return failure(ErrorKind::io, path.string() + ": expected a file, found a folder");
  const auto bytes = S_ISREG(status.st_mode) ? static_cast<std::size_t>(status.st_size) : 0;
  if (bytes > max_bytes) return too_large(path, std::to_string(bytes), max_bytes);
  try {
    return read_all(file.get(), path, bytes, max_bytes);
  } catch (const std::bad_alloc&) {
    return failure(ErrorKind::io, path.string() + ": not enough memory to read it");
  }
}

AtomicFile::AtomicFile(fs::path target, int descriptor, bool in_place)
    : target_(std::move(target)), descriptor_(descriptor), in_place_(in_place) {}

AtomicFile::AtomicFile(AtomicFile&& other) noexcept
    : target_(std::move(other.target_)),
      descriptor_(std::exchange(other.descriptor_, -1)),
      temporary_(std::move(other.temporary_)),
      old_(std::move(other.old_)),
      in_place_(other.in_place_),
      prepared_(other.prepared_),
      written_(other.written_),
      on_its_way_(other.on_its_way_) {}

AtomicFile::~AtomicFile() { discard(); }

Result<AtomicFile> AtomicFile::create(const fs::path& target) {
  const auto in_place = [&](int descriptor) -> Result<AtomicFile> {
    if (descriptor == -1) return io_failure(target, "could not open");
    return AtomicFile(target, descriptor, true);
  };
  if (target == "-") return in_place(::dup(STDOUT_FILENO));

  struct stat status {};
  const bool exists = ::stat(target.c_str(), &status) == 0;
  if (!exists && errno != ENOENT) return io_failure(target, "could not write");
  if ((exists && S_ISDIR(status.st_mode)) || !target.has_filename())
    return failure(ErrorKind::io,
                   target.string() + ": expected the name of a file, found a folder");
  if (exists && !S_ISREG(status.st_mode))
    return in_place(open_retrying(target, O_WRONLY | O_NOCTTY));
  // A rename does not check this permission.
  if (exists && ::access(target.c_str(), W_OK) == -1) return io_failure(target, "could not write");

  const fs::path resolved = behind_links(target);
  remove_litter(resolved);
  auto [descriptor, temporary] = open_beside(resolved);
  if (descriptor == -1) return io_failure(target, "could not create a file in its folder");
  AtomicFile file(resolved, descriptor, false);
  if (!temporary.empty()) file.temporary_ = std::make_unique<TemporaryName>(std::move(temporary));
  if (exists && ::fchmod(descriptor, status.st_mode & 07777) == -1)
    return io_failure(target, "could not keep the mode");
  return file;
}

Result<void> AtomicFile::write(std::span<const std::byte> bytes) {
  assert(!prepared_);
  const std::string_view text(reinterpret_cast<const char*>(bytes.data()), bytes.size());
  if (!write_all(descriptor_, text)) return give_up("could not write");
  written_ += bytes.size();
  begin_writeback();
  return {};
}

/// Starts writing a large file to disk while the rest is produced, so that the final sync is short.
/// Errors here are reported by the sync.
void AtomicFile::begin_writeback() noexcept {
  constexpr std::uint64_t kWorthACall = 8U << 20;
  if (in_place_ || written_ - on_its_way_ < kWorthACall) return;
  ::sync_file_range(descriptor_, static_cast<off64_t>(on_its_way_),
                    static_cast<off64_t>(written_ - on_its_way_), SYNC_FILE_RANGE_WRITE);
  on_its_way_ = written_;
}

Result<void> AtomicFile::read_at(std::uint64_t offset, std::span<std::byte> bytes) const {
  if (in_place_ || descriptor_ == -1)
    return failure(ErrorKind::io, target_.string() + ": what was written cannot be read again");
  while (!bytes.empty()) {
    const auto count = uninterrupted([&] {
      return ::pread(descriptor_, bytes.data(), bytes.size(), static_cast<off_t>(offset));
    });
    if (count < 0) return io_failure(target_, "could not read again");
    if (count == 0) return failure(ErrorKind::io, target_.string() + ": ends early");
    bytes = bytes.subspan(static_cast<std::size_t>(count));
    offset += static_cast<std::uint64_t>(count);
  }
  return {};
}

Result<void> AtomicFile::prepare() {
  if (prepared_) return {};
  if (descriptor_ == -1) {
    errno = EBADF;
    return give_up("could not write");
  }
  // Terminals and pipes have nothing to sync.
  if (!in_place_ && uninterrupted([&] { return ::fsync(descriptor_); }) == -1)
    return give_up("could not sync");
  // Some file systems report write errors only on close, also on the close of a duplicate; the file
  // itself stays open for its lock. If the limit of open files prevents a duplicate, the sync must
  // suffice. An interrupted close loses no later data.
  const int closing =
      in_place_ ? std::exchange(descriptor_, -1) : ::fcntl(descriptor_, F_DUPFD_CLOEXEC, 0);
  if (closing != -1 && ::close(closing) == -1 && errno != EINTR) return give_up("could not close");
  prepared_ = true;
  return {};
}

Result<void> AtomicFile::name() {
  if (in_place_ || temporary_) return {};
  const fs::path unnamed = name_in_proc(descriptor_);
  auto [result, name] = TemporaryName::take(target_, [&](const char* fresh) {
    return ::linkat(AT_FDCWD, unnamed.c_str(), AT_FDCWD, fresh, AT_SYMLINK_FOLLOW);
  });
  if (result == -1) return give_up("could not name");
  temporary_ = std::make_unique<TemporaryName>(std::move(name));
  return {};
}

Result<void> AtomicFile::keep_old() {
  struct stat status {};
  if (in_place_ || ::lstat(target_.c_str(), &status) == -1) return {};
  auto [result, old] = TemporaryName::take(
      target_, [&](const char* fresh) { return ::link(target_.c_str(), fresh); });
  if (result == -1) old = copy_beside(target_);  // for file systems without links, such as FAT
  if (old.empty()) return give_up("could not keep the old file");
  old.lock();
  old_ = std::make_unique<TemporaryName>(std::move(old));
  return {};
}

Result<void> AtomicFile::replace() {
  if (in_place_) return {};
  if (::rename(temporary_->path().c_str(), target_.c_str()) == -1)
    return give_up("could not replace");
  temporary_->release();
  return {};
}

std::string AtomicFile::put_back() {
  if (in_place_) return {};
  if (!old_) {
    if (::unlink(target_.c_str()) == 0) return {};
    return "; " + target_.string() + ": new, and cannot be removed: " + system_reason();
  }
  const bool back = ::rename(old_->path().c_str(), target_.c_str()) == 0;
  std::string trouble;
  if (!back)
    trouble = "; " + target_.string() + ": new, and the old file, " + old_->path().string() +
              ", cannot be put back: " + system_reason();
  old_->release();
  return trouble;
}

Result<void> AtomicFile::replace_all(std::span<AtomicFile* const> files) {
  const SignalsHeld held;
  for (std::size_t k = 0; k < files.size(); ++k) {
    auto replaced = files[k]->replace();
    if (replaced) continue;
    while (k-- > 0) replaced.error().message += files[k]->put_back();
    return replaced;
  }
  return {};
}

Result<void> AtomicFile::commit() { return commit_all(std::array{this}); }

Result<void> AtomicFile::give_up(const std::string& what) {
  auto error = io_failure(target_, what);
  discard();
  return error;
}

void AtomicFile::discard() noexcept {
  if (descriptor_ != -1) ::close(std::exchange(descriptor_, -1));
  temporary_.reset();
  old_.reset();
  prepared_ = false;
}

Result<void> commit_all(std::span<AtomicFile* const> files) {
  const auto each = [&](Result<void> (AtomicFile::*step)(), std::size_t count) -> Result<void> {
    for (AtomicFile* file : files.first(count))
      if (auto done = (file->*step)(); !done) return done;
    return {};
  };
  const std::size_t all = files.size();
  auto done = each(&AtomicFile::prepare, all)
                  .and_then([&] { return each(&AtomicFile::name, all); })
                  // Once the last file is in place, nothing can fail.
                  .and_then([&] { return each(&AtomicFile::keep_old, all == 0 ? 0 : all - 1); })
                  .and_then([&] { return AtomicFile::replace_all(files); });
  for (AtomicFile* file : files) file->discard();
  if (!done) return done;
  std::set<fs::path> folders;
  for (const AtomicFile* file : files)
    if (!file->in_place_) folders.insert(folder_of(file->target_));
  for (const fs::path& folder : folders) sync_folder(folder);
  return done;
}

void sync_folder(const fs::path& folder) noexcept {
  const Descriptor opened(open_retrying(folder, O_RDONLY | O_DIRECTORY));
  if (opened.get() != -1) (void)uninterrupted([&] { return ::fsync(opened.get()); });
}

Result<void> publish(const fs::path& target, std::string_view bytes) {
  return AtomicFile::create(target).and_then(
      [&](AtomicFile file) { return file.write(bytes).and_then([&] { return file.commit(); }); });
}

}  // namespace clay
