#pragma once
// The threads around the loop: the servo itself, and a watchdog that ends the force when the servo
// hangs. Whoever wants to end it all from a signal handler fires `last_zero()`.

#include "app/servo/servo_loop.hpp"
#include "claystack/falcon/guard.hpp"
#include "claystack/servo/servo.hpp"

#include <atomic>
#include <cstdint>
#include <thread>

namespace clay::servo {

inline constexpr int kServoPriority = 70, kWatchdogPriority = 80;

/// For the calling thread, and of memory for the process as it is then. Reported, never fatal.
[[nodiscard]] Realtime ask_for_realtime(int priority);

/// What signal handlers fire: the force of the servo that runs ends, for good.
[[nodiscard]] falcon::EmergencyStop& last_zero() noexcept;

class Servo {
 public:
  /// `bench` and `loop` outlive it. `realtime`: ask the system for it.
  Servo(const Bench& bench, ServoLoop& loop, bool realtime) noexcept
      : bench_(bench), loop_(loop), ask_realtime_(realtime) {}
  ~Servo();
  Servo(const Servo&) = delete;
  Servo& operator=(const Servo&) = delete;

  /// Ticks until the loop ends. The device is open. Once.
  void start();

  /// From one other thread. False: too many wait already.
  bool command(const Command& command) noexcept { return commands_.push(command); }

  /// For one reader.
  [[nodiscard]] LiveView& view() noexcept { return view_; }
  [[nodiscard]] bool running() const noexcept { return running_.load(std::memory_order_acquire); }

  /// Waits for the end. The device was told to give no force, as its last word.
  Ending join();

  /// After join().
  [[nodiscard]] const Realtime& realtime() const noexcept { return realtime_; }

 private:
  void run() noexcept;
  void watch() noexcept;

  Bench bench_;
  ServoLoop& loop_;
  bool ask_realtime_;
  Commands commands_;
  LiveView view_;
  falcon::ForceGate gate_;
  std::atomic<std::int64_t> heartbeat_us_{0};
  std::atomic<bool> running_{false};
  std::atomic<std::uint64_t> watchdog_ends_{0};
  Realtime realtime_;
  std::thread servo_, watchdog_;
};

}  // namespace clay::servo
