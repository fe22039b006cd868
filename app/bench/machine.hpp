#pragma once
#include <string>

namespace clay::bench {

/// The machine and build that produced the figures.
struct Machine {
  std::string cpu;  ///< model, as the system names it
  unsigned cores = 0;
  std::string system;    ///< kernel and architecture
  std::string compiler;  ///< with its version
  std::string flags;     ///< compiler flags
  std::string version;   ///< of Claystack, with the commit if known
};

[[nodiscard]] Machine this_machine();

}  // namespace clay::bench
