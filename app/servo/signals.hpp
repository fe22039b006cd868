#pragma once
// Signal handlers that send zero force before the process ends.

#include <csignal>
#include <utility>
#include <vector>

namespace clay::servo {

/// During its lifetime SIGINT, SIGTERM, SIGHUP and SIGPIPE end the force at once and request the
/// end of the program. Every other signal that would end the process and can be caught ends the
/// force and then has its default action: faults, SIGABRT (an uncaught exception, a failed
/// assertion), SIGQUIT, SIGXCPU (too long at SCHED_FIFO) and the rest. Job control is ignored,
/// because a stopped process would leave the force as it is; SIGXFSZ is ignored, because the failed
/// write reports an error. One object at a time.
class ForceSignals {
 public:
  ForceSignals();
  ~ForceSignals();
  ForceSignals(const ForceSignals&) = delete;
  ForceSignals& operator=(const ForceSignals&) = delete;

  /// The signal that requested the end; 0: none.
  [[nodiscard]] static int asked_to_stop() noexcept;

  /// An action after the force has ended, for signals that end the process, for example to restore
  /// the terminal. Async-signal-safe; nullptr: none.
  static void at_the_end(void (*act)() noexcept) noexcept;

 private:
  std::vector<std::pair<int, struct sigaction>> before_;
  stack_t stack_before_{};
};

}  // namespace clay::servo
