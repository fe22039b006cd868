#pragma once
// Signals while a force is on. Whatever ends the process, zero force goes out first.

#include <array>
#include <csignal>

namespace clay::live {

/// For as long as it lives: SIGINT, SIGTERM, SIGHUP and SIGPIPE end the force at once and ask the
/// program to stop; SIGSEGV, SIGBUS, SIGFPE, SIGILL and SIGABRT (so an uncaught exception, a failed
/// assertion) end the force and then do what they do. One at a time.
class ForceSignals {
 public:
  ForceSignals();
  ~ForceSignals();
  ForceSignals(const ForceSignals&) = delete;
  ForceSignals& operator=(const ForceSignals&) = delete;

  /// The signal that asked to stop; 0: none did.
  [[nodiscard]] static int asked_to_stop() noexcept;

 private:
  static constexpr std::array kSignals = {SIGINT, SIGTERM, SIGHUP, SIGPIPE, SIGSEGV,
                                          SIGBUS, SIGFPE,  SIGILL, SIGABRT};
  std::array<struct sigaction, kSignals.size()> before_{};
  stack_t stack_before_{};
};

}  // namespace clay::live
