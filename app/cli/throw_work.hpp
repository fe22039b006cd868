#pragma once
// Replays a work: `claystack throw NAME.work`.

#include "app/cli/console.hpp"

#include <cstddef>
#include <optional>
#include <string>

namespace clay::cli {

struct WorkJob {
  std::string work_path;
  std::string pot_path;           ///< empty: not saved
  std::optional<std::size_t> at;  ///< node; empty: the current one
  bool list = false;              ///< print the tree
};

Result<void> throw_work(const WorkJob& job, Console console);

}  // namespace clay::cli
