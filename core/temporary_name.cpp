#include "core/temporary_name.hpp"

#include "claystack/core/atomic_file.hpp"
#include "core/system_calls.hpp"

#include <sys/file.h>
#include <sys/stat.h>
#include <array>
#include <atomic>
#include <climits>
#include <cstring>
#include <string>
#include <system_error>

namespace clay {
namespace fs = std::filesystem;
namespace {

constexpr int kNames = 16;  // the names that are searched for leftover files

fs::path numbered(const fs::path& target, int number) {
  constexpr std::size_t kMostBytes = 64;  // short enough for every file system
  std::string name = target.filename().string();
  if (name.size() > kMostBytes) {
    std::size_t end = kMostBytes;
    const auto within_a_character = [&] { return (name[end] & 0xC0) == 0x80; };  // of UTF-8
    while (end > 0 && within_a_character()) --end;
    name.resize(end);
  }
  return folder_of(target) / ("." + name + ".claystack-" + std::to_string(number));
}

/// The paths that a signal handler removes. Fixed storage, because it must not allocate.
struct Slot {
  enum State { kFree, kTaken, kReady };
  std::atomic<int> state{kFree};
  char path[PATH_MAX] = {};
};
static_assert(std::atomic<int>::is_always_lock_free);
std::array<Slot, 64> slots;

/// -1: no slot is free, or the path is too long. Then a signal leaves the file.
int enter(const fs::path& path) {
  const std::string& text = path.native();
  if (text.size() >= PATH_MAX) return -1;
  for (std::size_t k = 0; k < slots.size(); ++k) {
    int free = Slot::kFree;
    if (!slots[k].state.compare_exchange_strong(free, Slot::kTaken)) continue;
    std::memcpy(slots[k].path, text.c_str(), text.size() + 1);
    slots[k].state.store(Slot::kReady);
    return static_cast<int>(k);
  }
  return -1;
}

void leave(int slot) noexcept {
  if (slot != -1) slots[static_cast<std::size_t>(slot)].state.store(Slot::kFree);
}

bool is_at(int descriptor, const fs::path& path) {
  struct stat open {
  }, named{};
  return ::fstat(descriptor, &open) == 0 && ::lstat(path.c_str(), &named) == 0 &&
         S_ISREG(named.st_mode) && same_file(open, named);
}

/// Holds the lock while checking and removing the name. Otherwise a second cleaner of the same file
/// could remove a file that a new writer has created since.
void remove_if_left(const fs::path& path) {
  const Descriptor file(open_retrying(path, O_RDWR | O_NOFOLLOW | O_NONBLOCK | O_NOCTTY));
  if (file.get() == -1 || ::flock(file.get(), LOCK_EX | LOCK_NB) == -1) return;
  if (is_at(file.get(), path)) ::unlink(path.c_str());
}

/// Returns -1 with EEXIST if another cleaner holds it.
int create_locked(const char* name) {
  constexpr mode_t kReadWriteForAll = 0666;  // less the umask
  const int file = ::open(name, O_CREAT | O_EXCL | O_RDWR | O_CLOEXEC, kReadWriteForAll);
  if (file == -1) return -1;
  const bool locked = ::flock(file, LOCK_EX | LOCK_NB) == 0;
  const bool lost = locked ? !is_at(file, name) : errno == EWOULDBLOCK;
  if (!lost) return file;
  ::close(file);
  errno = EEXIST;
  return -1;
}

/// Copies all bytes of one file to the other, which is empty.
bool copy_bytes(int from, int to) {
  std::array<char, 65536> chunk;
  for (;;) {
    const auto count = uninterrupted([&] { return ::read(from, chunk.data(), chunk.size()); });
    if (count <= 0) return count == 0;
    if (!write_all(to, {chunk.data(), static_cast<std::size_t>(count)})) return false;
  }
}

}  // namespace

TemporaryName::TemporaryName(fs::path path) : path_(std::move(path)), slot_(enter(path_)) {}

TemporaryName& TemporaryName::operator=(TemporaryName&& other) noexcept {
  remove();
  path_ = std::exchange(other.path_, {});
  slot_ = std::exchange(other.slot_, -1);
  locked_ = std::exchange(other.locked_, -1);
  return *this;
}

std::pair<int, TemporaryName> TemporaryName::take(const fs::path& target, const Make& make) {
  const SignalsHeld held;  // create and list the file, or neither
  for (int number = 1; number <= kNames + 1; ++number) {
    // The last resort is used where leftovers cannot be removed, because there are no locks.
    fs::path path = numbered(target, number <= kNames ? number : ::getpid());
    const int result = uninterrupted([&] { return make(path.c_str()); });
    if (result != -1) return {result, TemporaryName(std::move(path))};
    if (errno != EEXIST) break;
  }
  return {-1, TemporaryName()};
}

void TemporaryName::lock() noexcept {
  locked_ = open_retrying(path_, O_RDONLY | O_NOFOLLOW | O_NONBLOCK | O_NOCTTY);
  if (locked_ != -1) (void)::flock(locked_, LOCK_SH | LOCK_NB);
}

void TemporaryName::release() noexcept {
  if (locked_ != -1) ::close(std::exchange(locked_, -1));
  leave(std::exchange(slot_, -1));
  path_.clear();
}

void TemporaryName::remove() noexcept {
  if (!path_.empty()) ::unlink(path_.c_str());
  release();
}

std::pair<int, TemporaryName> open_temporary(const fs::path& target) {
  return TemporaryName::take(target, create_locked);
}

TemporaryName copy_beside(const fs::path& path) {
  const Descriptor original(open_retrying(path, O_RDONLY));
  struct stat status {};
  if (original.get() == -1 || ::fstat(original.get(), &status) == -1) return {};
  auto [descriptor, name] = open_temporary(path);
  const Descriptor copy(descriptor);
  const bool whole = descriptor != -1 && copy_bytes(original.get(), descriptor) &&
                     ::fchmod(descriptor, status.st_mode & 07777) == 0 &&
                     uninterrupted([&] { return ::fsync(copy.get()); }) == 0;
  if (whole) return std::move(name);
  const int error = errno;
  name.remove();
  errno = error;
  return {};
}

void remove_litter(const fs::path& target) {
  for (int number = 1; number <= kNames; ++number) remove_if_left(numbered(target, number));
}

void remove_temporary_files() noexcept {
  for (const Slot& slot : slots)
    if (slot.state.load() == Slot::kReady) ::unlink(slot.path);
}

}  // namespace clay
