#include "live/signals.hpp"

#include "live/servo.hpp"

#include <cstddef>

namespace clay::live {
namespace {

volatile std::sig_atomic_t asked = 0;

// For the thread that made ForceSignals: a stack that has run over can't hold a handler.
constexpr std::size_t kStackBytes = 64 * 1024;
alignas(16) char handler_stack[kStackBytes];

bool asks(int signal) {
  return signal == SIGINT || signal == SIGTERM || signal == SIGHUP || signal == SIGPIPE;
}

void on_ask(int signal) {
  last_zero().fire();
  asked = signal;
}

/// Back from here the fault befalls again, and then does what it does by default.
void on_fault(int signal) {
  last_zero().fire();
  std::signal(signal, SIG_DFL);
  std::raise(signal);
}

}  // namespace

ForceSignals::ForceSignals() {
  asked = 0;
  (void)last_zero();  // made before any handler asks for it
  stack_t stack{};
  stack.ss_sp = handler_stack;
  stack.ss_size = kStackBytes;
  sigaltstack(&stack, &stack_before_);
  for (std::size_t i = 0; i < kSignals.size(); ++i) {
    struct sigaction action {};
    action.sa_handler = asks(kSignals[i]) ? on_ask : on_fault;
    action.sa_flags = SA_ONSTACK;
    sigaction(kSignals[i], &action, &before_[i]);
  }
}

ForceSignals::~ForceSignals() {
  for (std::size_t i = 0; i < kSignals.size(); ++i) sigaction(kSignals[i], &before_[i], nullptr);
  if (stack_before_.ss_sp != handler_stack) sigaltstack(&stack_before_, nullptr);
}

int ForceSignals::asked_to_stop() noexcept { return asked; }

}  // namespace clay::live
