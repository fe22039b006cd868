#pragma once
// The threads around the loop: the servo, and a watchdog that ends the force when the servo hangs.
// Signal handlers end the force through `emergency_stop()`.

#include "app/servo/servo_loop.hpp"
#include "claystack/core/result.hpp"
#include "claystack/falcon/guard.hpp"
#include "claystack/servo/servo.hpp"

#include <atomic>
#include <cstdint>
#include <thread>

namespace clay::servo {

inline constexpr int kServoPriority = 70, kWatchdogPriority = 80;

/// Requests real-time scheduling for the calling thread and locks the current memory of the
/// process. Failures are reported, never fatal.
[[nodiscard]] Realtime request_realtime(int priority);
/// Undoes its locking of memory, for the whole process.
void unlock_memory() noexcept;

/// For signal handlers: permanently ends the force of the running servo.
[[nodiscard]] falcon::EmergencyStop& emergency_stop() noexcept;

class Servo {
 public:
  /// `parts` and `loop` must outlive it.
  Servo(const LoopParts& parts, ServoLoop& loop, Pace pace) noexcept
      : parts_(parts), loop_(loop), pace_(pace) {}
  ~Servo();
  Servo(const Servo&) = delete;
  Servo& operator=(const Servo&) = delete;

  /// Ticks until the loop ends. The device is open. Call once. An error of kind `io` if the system
  /// starts no thread; the force of the device has ended then.
  Result<void> start();

  /// Pace::stepped: ticks until the clock reaches `until_ns`, or to the end.
  void advance(std::int64_t until_ns) noexcept;

  /// For one other thread. False: the queue is full.
  bool command(const Command& command) noexcept { return commands_.push(command); }

  /// For one reader.
  [[nodiscard]] LiveView& view() noexcept { return view_; }
  [[nodiscard]] bool running() const noexcept { return running_.load(std::memory_order_acquire); }

  /// Waits for the end. The last force sent to the device is zero.
  Ending join();
  /// Ends it, whether or not the queue has room, and waits like join().
  Ending stop();

  /// After join().
  [[nodiscard]] const Realtime& realtime() const noexcept { return realtime_; }

 private:
  void run() noexcept;
  void tick() noexcept;
  void end() noexcept;
  void watch() noexcept;

  LoopParts parts_;
  ServoLoop& loop_;
  Pace pace_;
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
