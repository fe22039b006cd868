#include "app/studio/stored_works.hpp"

#include "app/history/file_lock.hpp"
#include "core/text.hpp"

#include <fmt/format.h>
#include <sys/stat.h>

#include <algorithm>
#include <system_error>

namespace clay::studio {

std::vector<StoredWork> stored_works(const std::filesystem::path& folder) {
  std::vector<StoredWork> works;
  std::error_code error;
  for (std::filesystem::directory_iterator at(folder, error), end; !error && at != end;
       at.increment(error)) {
    struct stat found {};
    const bool regular = ::stat(at->path().c_str(), &found) == 0 && S_ISREG(found.st_mode);
    if (!regular || !ends_ignoring_case(at->path().string(), ".work")) continue;
    works.push_back({at->path(), std::chrono::system_clock::from_time_t(found.st_mtime),
                     static_cast<std::uintmax_t>(found.st_size)});
  }
  std::ranges::sort(works, [](const StoredWork& a, const StoredWork& b) {
    return a.when != b.when ? a.when > b.when : a.path < b.path;
  });
  return works;
}

Result<void> delete_work(const std::filesystem::path& path) {
  const history::FileLock lock(path, history::FileLock::Kind::exclusive);
  if (lock.in_use())
    return failure(ErrorKind::io, fmt::format("{} is open in another window", path.string()));
  std::error_code error;
  if (!std::filesystem::remove(path, error) && error)
    return failure(ErrorKind::io,
                   fmt::format("{}: could not be deleted: {}", path.string(), error.message()));
  return {};
}

}  // namespace clay::studio
