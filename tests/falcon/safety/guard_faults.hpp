#pragma once
// The faults that a haptic loop meets, each a story that a trial goes through.

#include "tests/falcon/safety/guard_trial.hpp"

#include <span>

namespace clay::falcon {

struct GuardFault {
  int number;  ///< as in docs/force-guard.md
  const char* name;
  void (*happen)(Trial& trial);
};

[[nodiscard]] std::span<const GuardFault> guard_faults();

}  // namespace clay::falcon
