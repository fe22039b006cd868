#pragma once
// Signals while a force is on. Whatever ends the process, zero force goes out first.

#include <csignal>
#include <utility>
#include <vector>

namespace clay::servo {

/// For as long as it lives: SIGINT, SIGTERM, SIGHUP and SIGPIPE end the force at once and ask the
/// program to stop. Every other signal that would end the process and can be caught ends the force
/// and then does what it does: faults, SIGABRT (so an uncaught exception, a failed assertion),
/// SIGQUIT, SIGXCPU (too long at SCHED_FIFO) and the rest. Job control is ignored, since a process
/// that is stopped leaves the force as it is; so is SIGXFSZ, since a write that fails is told. One
/// of these at a time.
class ForceSignals {
 public:
  ForceSignals();
  ~ForceSignals();
  ForceSignals(const ForceSignals&) = delete;
  ForceSignals& operator=(const ForceSignals&) = delete;

  /// The signal that asked to stop; 0: none did.
  [[nodiscard]] static int asked_to_stop() noexcept;

  /// What a signal that ends the process does after the force has ended: a terminal is not left as
  /// it was made. Async-signal-safe; nullptr: nothing.
  static void at_the_end(void (*act)() noexcept) noexcept;

 private:
  std::vector<std::pair<int, struct sigaction>> before_;
  stack_t stack_before_{};
};

}  // namespace clay::servo
