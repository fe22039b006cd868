#pragma once
// Journals left by programs that ended without saving.

#include "app/history/journal.hpp"
#include "app/history/work.hpp"

#include <chrono>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace clay::history {

/// The journal of an ended program.
struct Recoverable {
  std::filesystem::path path;
  std::chrono::system_clock::time_point when;  ///< last written
  std::string scene;                           ///< its name
  std::size_t strokes = 0;
  double seconds = 0.0;         ///< of all strokes together
  bool running = false;         ///< it ended during a stroke
  std::optional<Error> damage;  ///< the unreadable part and its place
};

/// Newest first; without those of running programs. Removes journals without strokes, those whose
/// work was saved, and those that were not complete. Empty without a folder.
std::vector<Recoverable> recoverable(const std::filesystem::path& folder = recovery_folder());

/// The work, which continues the same journal. A stroke that was being recorded is included, except
/// for its last 100 ms. A journal with a damaged line is kept beside it as NAME.damaged
/// (NAME.damaged-2 and so on, if there is one).
Result<Work> recover(const std::filesystem::path& path);
/// Removes it. An error while its program runs.
Result<void> discard(const std::filesystem::path& path);

}  // namespace clay::history
