#pragma once
// A work again: `claystack throw NAME.work`.

#include "app/cli/console.hpp"

#include <cstddef>
#include <optional>
#include <string>

namespace clay::cli {

struct WorkJob {
  std::string work_path;
  std::string pot_path;           ///< empty: not kept
  std::optional<std::size_t> at;  ///< node; none: the current one
  bool list = false;              ///< print the tree
};

Result<void> throw_work(const WorkJob& job, Console console);

}  // namespace clay::cli
