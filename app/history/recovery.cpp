#include "app/history/recovery.hpp"

#include "app/history/file_lock.hpp"
#include "claystack/core/atomic_file.hpp"
#include "core/system_calls.hpp"
#include "core/time_units.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <system_error>
#include <utility>

namespace clay::history {
namespace {

namespace fs = std::filesystem;

/// The work that a journal offers; empty if none. `needless`: set if the journal can be deleted.
std::optional<Recoverable> look_at(const fs::path& path, bool& needless) {
  const FileLock lock(path, FileLock::Kind::shared);
  if (!lock.held()) return std::nullopt;
  Recoverable found;
  found.path = path;
  found.when = lock.written();
  const auto reading = read_file(path).and_then(
      [&](const std::string& text) { return salvage_work(text, path.string()); });
  if (!reading) {
    found.damage = reading.error();
    return found;
  }
  const WorkRecord& work = reading->work;
  found.scene = work.scenes[work.nodes[0].scene].name;
  found.strokes = work.nodes.size() - 1;
  for (const WorkNode& node : work.nodes)
    if (!node.poses.empty()) found.seconds += in_seconds(node.poses.back().time_us);
  found.running = reading->running;
  found.damage = reading->damage;
  const bool saved = work.saved_at == work.at && work.saved_nodes == work.nodes.size();
  needless = saved && !found.damage;
  return needless ? std::nullopt : std::optional(std::move(found));
}

/// Removes the file of a program that ended before its journal had a name. Does not remove a new
/// file: its program may be about to lock it.
void remove_unfinished(const fs::path& path) {
  constexpr auto kTimeToLock = std::chrono::minutes(1);
  const FileLock lock(path, FileLock::Kind::exclusive);
  if (lock.held() && std::chrono::system_clock::now() - lock.written() > kTimeToLock)
    (void)unlink(path.c_str());
}

}  // namespace

std::vector<Recoverable> recoverable(const fs::path& folder) {
  std::vector<Recoverable> all;
  std::error_code none;
  // A range-based loop would throw if reading the folder fails before its end.
  for (fs::directory_iterator entry(folder, none), end; !none && entry != end;
       entry.increment(none)) {
    const fs::path& path = entry->path();
    if (path.extension().native().starts_with(kUnfinishedJournal)) remove_unfinished(path);
    if (path.extension() != ".work") continue;
    bool needless = false;
    if (auto found = look_at(path, needless)) all.push_back(std::move(*found));
    if (needless) (void)discard(path);
  }
  std::ranges::sort(all, [](const Recoverable& a, const Recoverable& b) {
    return std::pair(a.when, a.path) > std::pair(b.when, b.path);
  });
  return all;
}

Result<Work> recover(const fs::path& path) {
  WorkReading found;
  auto journal = Journal::take_over(path, found);
  if (!journal) return tl::make_unexpected(journal.error());
  auto work = Work::open(std::move(found.work));
  if (!work) return failure(work.error().kind, path.string() + ": " + work.error().message);
  work->keep(std::move(*journal));
  return work;
}

Result<void> discard(const fs::path& path) {
  const FileLock lock(path, FileLock::Kind::exclusive);
  if (lock.opened() && !lock.held())
    return failure(ErrorKind::io,
                   fmt::format("{}: in use by a program that is running", path.string()));
  if (!lock.opened() || unlink(path.c_str()) != 0) return io_failure(path, "could not remove");
  return {};
}

}  // namespace clay::history
