#include "app/servo/signals.hpp"

#include "app/servo/servo.hpp"
#include "claystack/core/atomic_file.hpp"

#include <atomic>
#include <cstddef>

namespace clay::servo {
namespace {

constexpr int kStopRequests[] = {SIGINT, SIGTERM, SIGHUP, SIGPIPE};
// With the real-time signals: all that end the process by default, except those above and SIGKILL.
constexpr int kEnds[] = {SIGSEGV, SIGBUS,  SIGFPE,    SIGILL,  SIGABRT,   SIGQUIT,
                         SIGTRAP, SIGSYS,  SIGXCPU,   SIGALRM, SIGVTALRM, SIGPROF,
                         SIGUSR1, SIGUSR2, SIGSTKFLT, SIGPOLL, SIGPWR};
constexpr int kIgnored[] = {SIGTSTP, SIGTTIN, SIGTTOU, SIGXFSZ};

using Act = void (*)() noexcept;
// Handlers run on any thread.
std::atomic<int> asked{0};
std::atomic<Act> last_act{nullptr};
static_assert(std::atomic<int>::is_always_lock_free && std::atomic<Act>::is_always_lock_free);

// An alternate stack for the thread of ForceSignals: a handler cannot run on an overflowed stack.
constexpr std::size_t kStackBytes = std::size_t{64} * 1024;
alignas(16) char handler_stack[kStackBytes];

void on_stop_request(int signal) {
  emergency_stop().fire();
  asked = signal;
}

/// After the return the fault occurs again and has its default action.
void on_end(int signal) {
  emergency_stop().fire();
  if (const Act act = last_act.load(std::memory_order_acquire); act != nullptr) act();
  remove_temporary_files();
  std::signal(signal, SIG_DFL);
  std::raise(signal);
}

}  // namespace

ForceSignals::ForceSignals() {
  asked = 0;
  stack_t stack{};
  stack.ss_sp = handler_stack;
  stack.ss_size = kStackBytes;
  sigaltstack(&stack, &stack_before_);
  const auto handle = [this](int signal, void (*handler)(int)) {
    struct sigaction action {
    }, before{};
    action.sa_handler = handler;
    action.sa_flags = SA_ONSTACK;
    sigaction(signal, &action, &before);
    before_.emplace_back(signal, before);
  };
  // Also those that nohup ignores: without its terminal a throw has no key that ends the force.
  for (const int signal : kStopRequests) handle(signal, on_stop_request);
  for (const int signal : kEnds) handle(signal, on_end);
  // Some libraries handle one of these for their own use.
  for (int signal = SIGRTMIN; signal <= SIGRTMAX; ++signal) {
    struct sigaction action {};
    if (sigaction(signal, nullptr, &action) == 0 && action.sa_handler == SIG_DFL)
      handle(signal, on_end);
  }
  for (const int signal : kIgnored) handle(signal, SIG_IGN);
}

ForceSignals::~ForceSignals() {
  for (const auto& [signal, before] : before_) sigaction(signal, &before, nullptr);
  if (stack_before_.ss_sp != handler_stack) sigaltstack(&stack_before_, nullptr);
}

int ForceSignals::asked_to_stop() noexcept { return asked; }

void ForceSignals::at_the_end(Act act) noexcept { last_act.store(act, std::memory_order_release); }

}  // namespace clay::servo
