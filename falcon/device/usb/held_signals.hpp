#pragma once
// Threads that a library makes while this lives take no signal: a handler of ours that met one of
// them inside the library, and then asked the library for a last word, would wait for itself.

#include <pthread.h>

#include <csignal>

namespace clay::falcon::inline device {

class HeldSignals {
 public:
  HeldSignals() noexcept {
    sigset_t all;
    sigfillset(&all);
    // A fault befalls the thread that makes it, held or not.
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
