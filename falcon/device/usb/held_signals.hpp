#pragma once
// Blocks signals in threads that a library creates during this scope: a handler that interrupted
// one of them inside the library, and then called the library for the last packet, would deadlock.

#include <pthread.h>

#include <csignal>

namespace clay::falcon::inline device {

class HeldSignals {
 public:
  HeldSignals() noexcept {
    sigset_t all;
    sigfillset(&all);
    // A fault signal is delivered to the thread that caused it, blocked or not.
    for (const int fault : {SIGSEGV, SIGBUS, SIGFPE, SIGILL, SIGTRAP, SIGABRT, SIGSYS})
      sigdelset(&all, fault);
    pthread_sigmask(SIG_BLOCK, &all, &before_);
  }
  ~HeldSignals() { pthread_sigmask(SIG_SETMASK, &before_, nullptr); }
  HeldSignals(const HeldSignals&) = delete;
  HeldSignals& operator=(const HeldSignals&) = delete;

 private:
  sigset_t before_{};
};

}  // namespace clay::falcon::inline device
