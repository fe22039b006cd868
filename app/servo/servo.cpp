#include "app/servo/servo.hpp"

#include "claystack/falcon/guard.hpp"
#include "core/threads.hpp"

namespace clay::servo {
namespace {

void stop_device(void* device) noexcept { static_cast<falcon::HapticDevice*>(device)->stop(); }

}  // namespace

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

Result<void> Servo::start() {
  if (emergency_stop().is_armed())
    return failure(ErrorKind::bad_input, "could not start the servo: another one is running");
  // Until the first tick, readers see the status that the loop has kept: for example a pause.
  LiveStatus first = loop_.status();
  first.ending = Ending::none;
  view_.status.write(first);
  running_.store(true);
  emergency_stop().arm(gate_, &stop_device, &parts_.device);
  if (pace_ == Pace::stepped) {
    loop_.start();
    return {};
  }
  const auto started = with_threads("the servo's threads", [this] {
    watchdog_ = std::thread([this] { watch(); });
    servo_ = std::thread([this] { run(); });
  });
  if (!started) {
    end();
    join();
  }
  return started;
}

void Servo::advance(std::int64_t until_ns) noexcept {
  while (pace_ == Pace::stepped && running() && parts_.clock.now_ns() < until_ns) tick();
}

Ending Servo::join() {
  while (pace_ == Pace::stepped && running()) tick();
  if (servo_.joinable()) servo_.join();
  if (watchdog_.joinable()) {
    watchdog_.join();
    loop_.count_watchdog(watchdog_ends_.load());
    if (realtime_.memory_locked) unlock_memory();
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
  parts_.device.stop();
  emergency_stop().arm(gate_, nullptr, &parts_.device);
  running_.store(false, std::memory_order_release);
}

/// Supervises the servo from another thread. If the heartbeat stops for 10 ms, ends the force once.
/// The servo opens the gate again when it runs, after its guard has seen the delay.
void Servo::watch() noexcept {
  if (pace_ == Pace::real_time) (void)request_realtime(kWatchdogPriority);
  std::int64_t ended_us = -1;  // heartbeat at which the force was ended
  while (running()) {
    const std::int64_t beat_us = heartbeat_us_.load(std::memory_order_acquire);
    const std::int64_t now_us = parts_.clock.now_us();
    const bool ticks =
        beat_us != 0;  // before the first tick, the servo may still be requesting real time
    if (ticks && beat_us != ended_us && falcon::Watchdog::must_zero(beat_us, now_us) && running()) {
      gate_.shut();
      parts_.device.zero();
      watchdog_ends_.fetch_add(1, std::memory_order_relaxed);
      ended_us = beat_us;
    }
    const std::int64_t next_us = !ticks || beat_us == ended_us
                                     ? now_us + falcon::Watchdog::kPatienceUs
                                     : falcon::Watchdog::next_look_us(beat_us);
    parts_.clock.sleep_until_ns(1000 * next_us);
  }
}

}  // namespace clay::servo
