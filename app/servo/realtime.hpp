#pragma once
// What the system gives a servo when it is asked: a turn before all others, memory that is never
// paged out, sleeps that end on time.

#include <string>

namespace clay::servo {

struct Realtime {
  bool asked = false;
  bool fifo = false;  ///< SCHED_FIFO
  bool memory_locked = false;
  bool exact_sleep = false;  ///< timer slack of 1 ns
  std::string missing;       ///< what was not given, why, and what would help; empty: nothing
};

inline constexpr int kServoPriority = 70, kWatchdogPriority = 80;

/// For the calling thread, and of memory for the process as it is then. Reported, never fatal.
[[nodiscard]] Realtime ask_for_realtime(int priority);

}  // namespace clay::servo
