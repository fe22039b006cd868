#pragma once
// The faults of a haptic loop, each a sequence of ticks.

#include "tests/falcon/safety/guard_trial.hpp"

#include <span>

namespace clay::falcon {

struct GuardFault {
  int number;  ///< as in docs/force-guard.md
  const char* name;
  void (*run)(Trial& trial);
};

[[nodiscard]] std::span<const GuardFault> guard_faults();

}  // namespace clay::falcon
