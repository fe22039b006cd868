#pragma once
// The file that a work goes to as it happens, so that nothing of it is lost: docs/work.md. It is a
// work file in the state folder; its lock tells a living program's from a dead one's.

#include "claystack/core/result.hpp"
#include "claystack/engine/files.hpp"
#include "claystack/engine/tool.hpp"

#include <atomic>
#include <condition_variable>
#include <filesystem>
#include <memory>
#include <mutex>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <thread>

namespace clay::history {

/// The folder `recovery` in the user's folder for state: cli::user_folder. Empty without one.
[[nodiscard]] std::filesystem::path recovery_folder();

/// Lines are written at once, by whichever thread brings them; a thread of its own syncs them to
/// the disk when a stroke has ended, and every 30 s. Never for the servo's thread.
class Journal {
 public:
  /// Begins one with all that `work` holds.
  static Result<std::unique_ptr<Journal>> begin(
      const WorkRecord& work, const std::filesystem::path& folder = recovery_folder());
  /// Goes on with a dead one, after cutting off what is not sound. Refused while it is another's.
  static Result<std::unique_ptr<Journal>> take_over(const std::filesystem::path& path,
                                                    WorkReading& found);
  /// The file stays: what was not saved can be recovered.
  ~Journal();
  Journal(const Journal&) = delete;
  Journal& operator=(const Journal&) = delete;

  void append(std::string_view lines);
  void sync_soon();  ///< does not wait for it
  /// Waits until all is on the disk; the first error that there was.
  Result<void> sync();
  /// A clean end: the work was saved, or is not wanted. The file goes.
  void discard();

  [[nodiscard]] const std::filesystem::path& path() const noexcept { return path_; }
  /// The first thing that went wrong; nothing is written after it.
  [[nodiscard]] std::optional<Error> trouble() const;

 private:
  Journal(std::filesystem::path path, int descriptor);
  void run();

  std::filesystem::path path_;
  int descriptor_;
  mutable std::mutex mutex_;  // of what follows
  std::condition_variable wake_;
  std::optional<Error> trouble_;
  bool dirty_ = false, asked_ = false, closing_ = false;
  std::thread thread_;
};

}  // namespace clay::history
