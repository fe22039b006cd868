#include "app/history/journal.hpp"

#include "claystack/core/atomic_file.hpp"
#include "core/system_calls.hpp"
#include "core/threads.hpp"
#include "core/user_folder.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <chrono>
#include <system_error>
#include <utility>

namespace clay::history {
namespace {

namespace fs = std::filesystem;

constexpr int kMostDamaged = 100;
constexpr auto kSyncEvery = std::chrono::seconds(30);

bool synced(int descriptor) {
  return uninterrupted([&] { return fsync(descriptor); }) == 0;
}

/// Copies a journal to NAME.damaged, or NAME.damaged-2 and so on: the first name that is free.
Result<void> keep_damaged(const fs::path& path) {
  fs::path copy;
  std::error_code copied;
  for (int n = 1; n <= kMostDamaged; ++n) {
    copy = path.string() + (n == 1 ? ".damaged" : fmt::format(".damaged-{}", n));
    fs::copy_file(path, copy, copied);
    if (copied != std::errc::file_exists) break;
  }
  if (copied)
    return failure(ErrorKind::io,
                   fmt::format("{}: could not write: {}", copy.string(), copied.message()));
  const Descriptor file(open_retrying(copy, O_RDONLY));
  if (file.get() == -1 || !synced(file.get())) return io_failure(copy, "could not sync");
  return {};
}

/// Renames a file to a name that no file has. False: errno has the reason.
bool move_to_new(const fs::path& from, const fs::path& to) {
  if (link(from.c_str(), to.c_str()) == 0) return unlink(from.c_str()) == 0;
  // File systems without hard links: those of cameras' cards, and of a web page.
  if (errno != EPERM && errno != EMLINK && errno != EOPNOTSUPP) return false;
  if (access(to.c_str(), F_OK) == 0) {
    errno = EEXIST;
    return false;
  }
  return rename(from.c_str(), to.c_str()) == 0;
}

/// The file is named after it is locked and has its header, so that no other process treats it as
/// abandoned.
Result<fs::path> give_name(int descriptor, const fs::path& temporary, const fs::path& folder,
                           const std::string& stem) {
  for (int twin = 0; twin < 100; ++twin) {
    const fs::path path =
        folder / (twin == 0 ? fmt::format("{}.work", stem) : fmt::format("{}-{}.work", stem, twin));
    if (move_to_new(temporary, path)) {
      if (!synced(descriptor)) {
        const auto failed = io_failure(path, "could not sync");
        (void)unlink(path.c_str());
        return failed;
      }
      sync_folder(folder);
      return path;
    }
    if (errno != EEXIST) break;
  }
  return io_failure(folder / stem, "could not create");
}

}  // namespace

fs::path recovery_folder() {
  const fs::path folder = user_folder(UserFolder::state);
  return folder.empty() ? folder : folder / "recovery";
}

Result<std::unique_ptr<Journal>> Journal::begin(const WorkRecord& work, const fs::path& folder) {
  if (folder.empty()) return failure(ErrorKind::io, std::string("journal: ") + kNoHome);
  std::error_code made;
  fs::create_directories(folder, made);
  if (made)
    return failure(ErrorKind::io,
                   fmt::format("{}: could not create: {}", folder.string(), made.message()));
  const std::string stem = time_and_process();
  std::string temporary = (folder / fmt::format("{}{}XXXXXX", stem, kUnfinishedJournal)).string();
  const int descriptor = mkostemp(temporary.data(), O_APPEND | O_CLOEXEC);
  if (descriptor < 0) return io_failure(folder / stem, "could not create");
  std::unique_ptr<Journal> journal(new Journal(temporary, descriptor));
  const auto given_up = [&](Error error) {
    (void)unlink(temporary.c_str());
    return tl::make_unexpected(std::move(error));
  };
  if (auto started = journal->start(); !started) return given_up(started.error());
  if (flock(descriptor, LOCK_EX | LOCK_NB) != 0)
    return given_up(io_failure(temporary, "could not lock").value());
  journal->append(write_work(work) + work_saved_line(work.saved_at, work.saved_nodes));
  if (const auto trouble = journal->trouble()) return given_up(*trouble);
  auto named = give_name(descriptor, temporary, folder, stem);
  if (!named) return given_up(named.error());
  const std::lock_guard lock(journal->mutex_);
  journal->path_ = std::move(*named);
  return journal;
}

Result<std::unique_ptr<Journal>> Journal::take_over(const fs::path& path, WorkReading& found) {
  // Opening never blocks, even if the file with that name is a pipe or a device.
  const int descriptor = open(path.c_str(), O_RDWR | O_APPEND | O_CLOEXEC | O_NONBLOCK | O_NOCTTY);
  if (descriptor < 0) return io_failure(path, "could not open");
  std::unique_ptr<Journal> journal(new Journal(path, descriptor));
  if (auto started = journal->start(); !started) return tl::make_unexpected(started.error());
  struct stat status {};
  if (fstat(descriptor, &status) != 0 || !S_ISREG(status.st_mode))
    return failure(ErrorKind::io, fmt::format("{}: expected a regular file", path.string()));
  if (flock(descriptor, LOCK_EX | LOCK_NB) != 0)
    return failure(ErrorKind::io,
                   fmt::format("{}: in use by a program that is running", path.string()));
  auto reading = read_file(path).and_then(
      [&](const std::string& text) { return salvage_work(text, path.string()); });
  if (!reading) return tl::make_unexpected(reading.error());
  if (reading->damage) {
    if (auto kept = keep_damaged(path); !kept) return tl::make_unexpected(kept.error());
  }
  if (ftruncate(descriptor, static_cast<off_t>(reading->sound_bytes)) != 0)
    return io_failure(path, "could not shorten");
  if (reading->running) journal->append(work_end_line(reading->work.nodes.back().poses.size(), {}));
  found = std::move(*reading);
  return journal;
}

Journal::Journal(fs::path path, int descriptor) : path_(std::move(path)), descriptor_(descriptor) {}

Journal::~Journal() {
  if (worker_) worker_->close();
  (void)close(descriptor_);
}

Result<void> Journal::start() {
  return with_threads("the journal's thread",
                      [this] { worker_.emplace([this](bool) { sync_changes(); }, kSyncEvery); });
}

void Journal::append(std::string_view lines) {
  const std::lock_guard lock(mutex_);
  if (trouble_) return;
  if (!write_all(descriptor_, lines)) trouble_ = io_failure(path_, "could not write").value();
  dirty_ = true;
}

void Journal::sync_soon() { worker_->wake(); }

void Journal::discard() {
  const std::lock_guard lock(mutex_);
  (void)unlink(path_.c_str());
  dirty_ = false;
}

std::optional<Error> Journal::trouble() const {
  const std::lock_guard lock(mutex_);
  return trouble_;
}

/// Syncs without holding the mutex, so that appending continues.
void Journal::sync_changes() {
  {
    const std::lock_guard lock(mutex_);
    if (!std::exchange(dirty_, false)) return;
  }
  if (synced(descriptor_)) return;
  const int reason = errno;
  const std::lock_guard lock(mutex_);
  errno = reason;
  if (!trouble_) trouble_ = io_failure(path_, "could not sync").value();
}

}  // namespace clay::history
