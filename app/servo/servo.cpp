#include "app/servo/servo.hpp"

#include "claystack/falcon/guard.hpp"

namespace clay::servo {
namespace {

void stop_device(void* device) noexcept { static_cast<falcon::HapticDevice*>(device)->stop(); }

}  // namespace

falcon::EmergencyStop& last_zero() noexcept {
  // In static memory: a handler may run before main, or after it.
  static constinit falcon::EmergencyStop last;
  return last;
}

Servo::~Servo() {
  // Without room for the command the gate says it too.
  if (!command({CommandKind::stop, 0.0})) gate_.shut_for_good();
  join();
}

void Servo::start() {
  running_.store(true);
  last_zero().arm(gate_, &stop_device, &bench_.device);
  watchdog_ = std::thread([this] { watch(); });
  servo_ = std::thread([this] { run(); });
}

Ending Servo::join() {
  if (servo_.joinable()) servo_.join();
  if (watchdog_.joinable()) {
    watchdog_.join();
    loop_.count_watchdog(watchdog_ends_.load());
  }
  return loop_.status().ending;
}

void Servo::run() noexcept {
  if (ask_realtime_) realtime_ = ask_for_realtime(kServoPriority);
  loop_.start();
  while (loop_.tick(gate_, commands_, view_, heartbeat_us_) == Ending::none) {
  }
  // No signal reaches for the device from here on: its last word is said.
  gate_.shut_for_good();
  bench_.device.stop();
  last_zero().arm(gate_, nullptr, &bench_.device);
  running_.store(false, std::memory_order_release);
}

/// The servo can't watch itself. A heartbeat that stands for 10 ms ends the force once; the servo
/// opens the gate again when it is alive, and its guard has seen how late it is.
void Servo::watch() noexcept {
  if (ask_realtime_) (void)ask_for_realtime(kWatchdogPriority);
  std::int64_t ended_us = -1;  // the heartbeat after which it was
  while (running()) {
    const std::int64_t beat_us = heartbeat_us_.load(std::memory_order_acquire);
    const std::int64_t now_us = bench_.clock.now_us();
    const bool ticks = beat_us != 0;  // it may still be asking for real time
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
