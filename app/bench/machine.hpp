#pragma once
#include <string>

namespace clay::bench {

/// Where the figures come from: no figure without it.
struct Machine {
  std::string cpu;  ///< model, as the system names it
  unsigned cores = 0;
  std::string system;    ///< kernel and architecture
  std::string compiler;  ///< with its version
  std::string flags;     ///< that everything was compiled with
  std::string version;   ///< of Claystack, with the commit where it is known
};

[[nodiscard]] Machine this_machine();

}  // namespace clay::bench
