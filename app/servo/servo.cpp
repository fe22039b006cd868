#include "app/servo/servo.hpp"

#include "claystack/falcon/guard.hpp"

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

void stop_device(void* device) noexcept { static_cast<falcon::HapticDevice*>(device)->stop(); }

}  // namespace

Realtime request_realtime(int priority) {
  Realtime realtime;
  realtime.asked = true;
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

falcon::EmergencyStop& emergency_stop() noexcept {
  // Static memory, because a handler may run before main or after it.
  static constinit falcon::EmergencyStop last;
  return last;
}

Servo::~Servo() { stop(); }

Ending Servo::stop() {
  // If the command queue is full, the gate ends the force instead.
  if (!command({CommandKind::stop, 0.0})) gate_.shut_for_good();
  return join();
}

void Servo::start() {
  running_.store(true);
  emergency_stop().arm(gate_, &stop_device, &bench_.device);
  if (pace_ == Pace::stepped) return loop_.start();
  watchdog_ = std::thread([this] { watch(); });
  servo_ = std::thread([this] { run(); });
}

void Servo::advance(std::int64_t until_ns) noexcept {
  while (pace_ == Pace::stepped && running() && bench_.clock.now_ns() < until_ns) tick();
}

Ending Servo::join() {
  while (pace_ == Pace::stepped && running()) tick();
  if (servo_.joinable()) servo_.join();
  if (watchdog_.joinable()) {
    watchdog_.join();
    loop_.count_watchdog(watchdog_ends_.load());
  }
  return loop_.status().ending;
}

void Servo::run() noexcept {
  if (pace_ == Pace::real_time) realtime_ = request_realtime(kServoPriority);
  loop_.start();
  while (running()) tick();
}

void Servo::tick() noexcept {
  if (loop_.tick(gate_, commands_, view_, heartbeat_us_) != Ending::none) end();
}

void Servo::end() noexcept {
  // From here on signal handlers do not use the device: it has received its last force.
  gate_.shut_for_good();
  bench_.device.stop();
  emergency_stop().arm(gate_, nullptr, &bench_.device);
  running_.store(false, std::memory_order_release);
}

/// Supervises the servo from another thread. If the heartbeat stops for 10 ms, ends the force once.
/// The servo opens the gate again when it runs, after its guard has seen the delay.
void Servo::watch() noexcept {
  if (pace_ == Pace::real_time) (void)request_realtime(kWatchdogPriority);
  std::int64_t ended_us = -1;  // heartbeat at which the force was ended
  while (running()) {
    const std::int64_t beat_us = heartbeat_us_.load(std::memory_order_acquire);
    const std::int64_t now_us = bench_.clock.now_us();
    const bool ticks =
        beat_us != 0;  // before the first tick, the servo may still be requesting real time
    if (ticks && beat_us != ended_us && falcon::Watchdog::must_zero(beat_us, now_us) && running()) {
      gate_.shut();
      bench_.device.zero();
      watchdog_ends_.fetch_add(1, std::memory_order_relaxed);
      ended_us = beat_us;
    }
    const std::int64_t next_us = !ticks || beat_us == ended_us
                                     ? now_us + falcon::Watchdog::kPatienceUs
                                     : falcon::Watchdog::next_look_us(beat_us);
    bench_.clock.sleep_until_ns(1000 * next_us);
  }
}

}  // namespace clay::servo
