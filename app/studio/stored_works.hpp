#pragma once
// The works in the folder of saved files; in a page, all works that the browser keeps.

#include "claystack/core/result.hpp"

#include <chrono>
#include <cstdint>
#include <filesystem>
#include <vector>

namespace clay::studio {

struct StoredWork {
  std::filesystem::path path;
  std::chrono::system_clock::time_point when;  ///< of its last change
  std::uintmax_t bytes = 0;
};

/// Newest first. A folder that cannot be read holds none.
[[nodiscard]] std::vector<StoredWork> stored_works(const std::filesystem::path& folder);
/// Refuses (`io`) while another window has it open. A file that no longer exists is no error.
Result<void> delete_work(const std::filesystem::path& path);

}  // namespace clay::studio
