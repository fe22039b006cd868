#pragma once
// What programs that died have left: their journals.

#include "app/history/journal.hpp"
#include "app/history/work.hpp"

#include <chrono>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace clay::history {

/// A dead program's journal.
struct Recoverable {
  std::filesystem::path path;
  std::chrono::system_clock::time_point when;  ///< last written
  std::string scene;                           ///< its name
  std::size_t strokes = 0;
  double seconds = 0.0;         ///< of all strokes together
  bool running = false;         ///< it died in mid-stroke
  std::optional<Error> damage;  ///< what cannot be read of it, and where
};

/// Newest first; without those of living programs. Those with no strokes, and those whose work was
/// saved as it is, are removed. No folder: none.
std::vector<Recoverable> recoverable(const std::filesystem::path& folder = recovery_folder());

/// The work, with the same journal going on. A stroke that was being recorded is there, but for its
/// last 100 ms. A journal with a damaged line is kept beside as NAME.damaged.
Result<Work> recover(const std::filesystem::path& path);
/// Removes it. An error while it is a living program's.
Result<void> discard(const std::filesystem::path& path);

}  // namespace clay::history
