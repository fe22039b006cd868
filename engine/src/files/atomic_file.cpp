#include "claystack/engine/atomic_file.hpp"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>
#include <algorithm>
#include <array>
#include <atomic>
#include <cerrno>
#include <cstdio>
#include <new>
#include <system_error>
#include <utility>

namespace clay {
namespace fs = std::filesystem;
namespace {

std::string cause() { return std::error_code(errno, std::system_category()).message(); }

/// Speaks of `errno`, so call it before anything else can change that.
tl::unexpected<Error> io_failure(const fs::path& path, const std::string& what) {
  return failure(ErrorKind::io, path.string() + ": " + what + ": " + cause());
}

/// A call until no signal interrupts it.
template <class Call>
auto uninterrupted(Call call) {
  auto result = call();
  while (result == -1 && errno == EINTR) result = call();
  return result;
}

int open_retrying(const fs::path& path, int flags, mode_t mode = 0) {
  return uninterrupted([&] { return ::open(path.c_str(), flags | O_CLOEXEC, mode); });
}

/// Closes what it holds at the end of its scope.
class Descriptor {
 public:
  explicit Descriptor(int descriptor) : descriptor_(descriptor) {}
  Descriptor(const Descriptor&) = delete;
  Descriptor& operator=(const Descriptor&) = delete;
  ~Descriptor() {
    if (descriptor_ != -1) ::close(descriptor_);
  }
  [[nodiscard]] int get() const noexcept { return descriptor_; }

 private:
  int descriptor_;
};

tl::unexpected<Error> too_large(const fs::path& path, const std::string& found,
                                std::size_t max_bytes) {
  return failure(ErrorKind::io, path.string() + ": expected at most " + std::to_string(max_bytes) +
                                    " bytes, found " + found);
}

/// To the end of the file; `expected_bytes` is a hint.
Result<std::string> read_all(int descriptor, const fs::path& path, std::size_t expected_bytes,
                             std::size_t max_bytes) {
  std::string text;
  text.reserve(expected_bytes);
  std::array<char, 65536> chunk;
  for (;;) {
    const auto count =
        uninterrupted([&] { return ::read(descriptor, chunk.data(), chunk.size()); });
    if (count < 0) return io_failure(path, "cannot read");
    if (count == 0) return text;
    if (static_cast<std::size_t>(count) > max_bytes - text.size())
      return too_large(path, "more", max_bytes);
    text.append(chunk.data(), static_cast<std::size_t>(count));
  }
}

/// Where a file of this name is or would be, behind all symbolic links.
fs::path behind_links(fs::path path) {
  constexpr int kMaxLinks = 40;  // as in Linux
  std::error_code none;
  for (int i = 0; i < kMaxLinks && fs::is_symlink(path, none); ++i)
    path = path.parent_path() / fs::read_symlink(path, none);
  return path;
}

fs::path folder_of(const fs::path& target) {
  return target.has_parent_path() ? target.parent_path() : fs::path(".");
}

/// No other process uses its names, and no other call of this one.
fs::path temporary_name(const fs::path& folder) {
  static std::atomic<unsigned> calls = 0;
  return folder / (".claystack-" + std::to_string(::getpid()) + "-" + std::to_string(++calls));
}

/// make(name) with a fresh name in the folder; passes over what a killed process left there.
template <class Make>
std::pair<int, fs::path> with_fresh_name(const fs::path& folder, Make make) {
  constexpr int kAttempts = 100;
  for (int i = 0;; ++i) {
    fs::path name = temporary_name(folder);
    const int result = uninterrupted([&] { return make(name.c_str()); });
    if (result != -1 || errno != EEXIST || i == kAttempts) return {result, std::move(name)};
  }
}

constexpr mode_t kReadWriteForAll = 0666;  // less the umask

/// Without a name where the file system can do that, else with a temporary one.
std::pair<int, fs::path> open_in(const fs::path& folder) {
  const int unnamed = open_retrying(folder, O_TMPFILE | O_RDWR, kReadWriteForAll);
  // EISDIR: a kernel that does not know O_TMPFILE.
  if (unnamed != -1 || (errno != EOPNOTSUPP && errno != EISDIR)) return {unnamed, {}};
  return with_fresh_name(folder, [](const char* name) {
    return ::open(name, O_CREAT | O_EXCL | O_RDWR | O_CLOEXEC, kReadWriteForAll);
  });
}

}  // namespace

Result<std::string> read_file(const fs::path& path, std::size_t max_bytes) {
  const Descriptor file(path == "-" ? ::dup(STDIN_FILENO) : open_retrying(path, O_RDONLY));
  if (file.get() == -1) return io_failure(path, "cannot open");
  struct stat status {};
  if (::fstat(file.get(), &status) == -1) return io_failure(path, "cannot read");
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

AtomicFile::AtomicFile(fs::path target, int descriptor, fs::path temporary, bool in_place)
    : target_(std::move(target)),
      descriptor_(descriptor),
      temporary_(std::move(temporary)),
      in_place_(in_place) {}

AtomicFile::AtomicFile(AtomicFile&& other) noexcept
    : target_(std::move(other.target_)),
      descriptor_(std::exchange(other.descriptor_, -1)),
      temporary_(std::exchange(other.temporary_, {})),
      in_place_(other.in_place_),
      written_(other.written_),
      on_its_way_(other.on_its_way_) {}

AtomicFile::~AtomicFile() { discard(); }

Result<AtomicFile> AtomicFile::create(const fs::path& target) {
  const auto in_place = [&](int descriptor) -> Result<AtomicFile> {
    if (descriptor == -1) return io_failure(target, "cannot open");
    return AtomicFile(target, descriptor, {}, true);
  };
  if (target == "-") return in_place(::dup(STDOUT_FILENO));

  struct stat status {};
  const bool exists = ::stat(target.c_str(), &status) == 0;
  if (!exists && errno != ENOENT) return io_failure(target, "cannot write");
  if ((exists && S_ISDIR(status.st_mode)) || !target.has_filename())
    return failure(ErrorKind::io,
                   target.string() + ": expected the name of a file, found a folder");
  if (exists && !S_ISREG(status.st_mode))
    return in_place(open_retrying(target, O_WRONLY | O_NOCTTY));
  // A rename would not ask.
  if (exists && ::access(target.c_str(), W_OK) == -1) return io_failure(target, "cannot write");

  const fs::path resolved = behind_links(target);
  auto [descriptor, temporary] = open_in(folder_of(resolved));
  if (descriptor == -1) return io_failure(target, "cannot create a file in its folder");
  AtomicFile file(resolved, descriptor, std::move(temporary), false);
  if (exists && ::fchmod(descriptor, status.st_mode & 07777) == -1)
    return io_failure(target, "cannot keep the mode");
  return file;
}

Result<void> AtomicFile::write(std::span<const std::byte> bytes) {
  while (!bytes.empty()) {
    const auto count =
        uninterrupted([&] { return ::write(descriptor_, bytes.data(), bytes.size()); });
    if (count < 0) return give_up("cannot write");
    bytes = bytes.subspan(static_cast<std::size_t>(count));
    written_ += static_cast<std::uint64_t>(count);
  }
  begin_writeback();
  return {};
}

/// A large file is on its way to the disk while the rest of it is made, so that the sync at the end
/// is short. What goes wrong here the sync will tell.
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
    if (count < 0) return io_failure(target_, "cannot read again");
    if (count == 0) return failure(ErrorKind::io, target_.string() + ": ends early");
    bytes = bytes.subspan(static_cast<std::size_t>(count));
    offset += static_cast<std::uint64_t>(count);
  }
  return {};
}

Result<void> AtomicFile::commit() {
  // Terminals and pipes have nothing to sync.
  if (!in_place_ && uninterrupted([&] { return ::fsync(descriptor_); }) == -1)
    return give_up("cannot sync");
  if (!in_place_ && temporary_.empty()) {
    const std::string unnamed = "/proc/self/fd/" + std::to_string(descriptor_);
    auto [result, name] = with_fresh_name(folder_of(target_), [&](const char* fresh) {
      return ::linkat(AT_FDCWD, unnamed.c_str(), AT_FDCWD, fresh, AT_SYMLINK_FOLLOW);
    });
    if (result == -1) return give_up("cannot name");
    temporary_ = std::move(name);
  }
  // Closed by Linux whatever the result, and an interrupted close has lost nothing after a sync.
  if (::close(std::exchange(descriptor_, -1)) == -1 && errno != EINTR)
    return give_up("cannot close");
  if (in_place_) return {};
  if (::rename(temporary_.c_str(), target_.c_str()) == -1) return give_up("cannot replace");
  temporary_.clear();
  return sync_folder(folder_of(target_));
}

Result<void> AtomicFile::give_up(const std::string& what) {
  auto error = io_failure(target_, what);
  discard();
  return error;
}

void AtomicFile::discard() noexcept {
  if (descriptor_ != -1) ::close(std::exchange(descriptor_, -1));
  if (!temporary_.empty()) ::unlink(temporary_.c_str());
  temporary_.clear();
}

Result<void> sync_folder(const fs::path& folder) {
  const Descriptor opened(open_retrying(folder, O_RDONLY | O_DIRECTORY));
  if (opened.get() == -1) return io_failure(folder, "cannot open the folder");
  if (uninterrupted([&] { return ::fsync(opened.get()); }) == -1)
    return io_failure(folder, "cannot sync the folder");
  return {};
}

Result<void> publish(const fs::path& target, std::string_view bytes) {
  return AtomicFile::create(target).and_then(
      [&](AtomicFile file) { return file.write(bytes).and_then([&] { return file.commit(); }); });
}

}  // namespace clay
