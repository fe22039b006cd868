#pragma once
// The file that records a work as it happens, so that a crash loses nothing: docs/work.md. It is a
// work file in the state folder; its lock distinguishes running programs from ended ones.

#include "claystack/core/result.hpp"
#include "claystack/engine/files.hpp"
#include "claystack/engine/tool.hpp"
#include "core/worker.hpp"

#include <filesystem>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <string_view>

namespace clay::history {

/// The folder `recovery` in the user's state folder (clay::user_folder). Empty without one.
[[nodiscard]] std::filesystem::path recovery_folder();

/// Before a journal has its name, NAME.work, it is complete in a file with this in its extension.
inline constexpr std::string_view kUnfinishedJournal = ".new-";

/// Lines are written immediately, by the calling thread; a separate thread syncs them to disk at
/// the end of a stroke and every 30 s. Not for the servo's thread.
class Journal {
 public:
  /// Creates a journal with all contents of `work`.
  static Result<std::unique_ptr<Journal>> begin(
      const WorkRecord& work, const std::filesystem::path& folder = recovery_folder());
  /// Continues the journal of an ended program, after cutting off damaged lines. Refused while
  /// another program holds it.
  static Result<std::unique_ptr<Journal>> take_over(const std::filesystem::path& path,
                                                    WorkReading& found);
  /// Keeps the file: unsaved strokes can be recovered.
  ~Journal();
  Journal(const Journal&) = delete;
  Journal& operator=(const Journal&) = delete;

  void append(std::string_view lines);
  void sync_soon();  ///< does not wait
  /// Deletes the file: the work was saved, or is not needed.
  void discard();

  [[nodiscard]] const std::filesystem::path& path() const noexcept { return path_; }
  /// The first error; nothing is written after it.
  [[nodiscard]] std::optional<Error> trouble() const;

 private:
  Journal(std::filesystem::path path, int descriptor);
  /// Starts the thread that syncs.
  Result<void> start();
  void sync_changes();

  std::filesystem::path path_;
  int descriptor_;
  mutable std::mutex mutex_;  // protects the next two members, and path_ until begin() has ended
  std::optional<Error> trouble_;
  bool dirty_ = false;
  std::optional<PeriodicWorker> worker_;  // last: it uses all members above
};

}  // namespace clay::history
