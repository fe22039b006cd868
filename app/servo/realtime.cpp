#include "app/servo/servo.hpp"

#include <pthread.h>
#include <sched.h>
#include <sys/mman.h>
#include <sys/prctl.h>

#include <array>
#include <cerrno>
#include <system_error>

namespace clay::servo {
namespace {

// More stack than the servo's deepest call needs. It is touched in advance, so that no tick causes
// a page fault.
constexpr std::size_t kStackBytes = 128 * 1024;

void touch_stack() noexcept {
  std::array<char, kStackBytes> stack;
  volatile char* page = stack.data();
  for (std::size_t at = 0; at < stack.size(); at += 1024) page[at] = 0;
}

void note(std::string& missing, const char* what, int error, const char* help) {
  if (!missing.empty()) missing += "; ";
  missing.append(what).append(": ").append(std::generic_category().message(error));
  missing.append(" (").append(help).append(")");
}

}  // namespace

Realtime request_realtime(int priority) {
  Realtime realtime;
  sched_param parameters{};
  parameters.sched_priority = priority;
  const int refused = pthread_setschedparam(pthread_self(), SCHED_FIFO, &parameters);
  realtime.fifo = refused == 0;
  if (!realtime.fifo)
    note(realtime.missing, "no SCHED_FIFO", refused, "set rtprio in limits.conf, or CAP_SYS_NICE");
  touch_stack();
  // Current pages only: with a limit on locked memory, MCL_FUTURE would make later allocations
  // fail.
  realtime.memory_locked = mlockall(MCL_CURRENT) == 0;
  if (!realtime.memory_locked)
    note(realtime.missing, "memory not locked", errno, "set memlock in limits.conf");
  realtime.exact_sleep = prctl(PR_SET_TIMERSLACK, 1, 0, 0, 0) == 0;
  if (!realtime.exact_sleep) note(realtime.missing, "timer slack", errno, "sleeps end late");
  return realtime;
}

void unlock_memory() noexcept { munlockall(); }

}  // namespace clay::servo
