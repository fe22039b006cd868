#pragma once
// One owner of the force, and a last packet that is zero. The servo passes the gate for each packet
// it writes. Whoever has to end the force (the watchdog, a signal, an exception, the end of the
// program) closes the gate and then writes zero himself; a servo that was inside meanwhile is told
// on its way out, and writes zero once more. So in every order of events the last whole packet
// is a zero, and no two threads command a force.

#include <atomic>
#include <cstdint>

namespace clay::falcon {

class ForceGate {
 public:
  /// The servo, before it writes a force. False: it must not, since the gate is shut or another
  /// thread is inside.
  [[nodiscard]] bool enter() noexcept {
    std::uint32_t open = 0;
    return state_.compare_exchange_strong(open, kInside, std::memory_order_acquire,
                                          std::memory_order_relaxed);
  }

  /// After it has written. False: the gate was shut meanwhile, so zero has to be written again.
  [[nodiscard]] bool leave() noexcept {
    return (state_.fetch_and(~kInside, std::memory_order_release) & kShut) == 0;
  }

  /// No force from now on: to be called before writing zero. Safe in a signal handler.
  void shut() noexcept { state_.fetch_or(kShut, std::memory_order_acq_rel); }

  /// Lets forces through again. Only the servo may, when it is alive again after the watchdog shut
  /// the gate, and its guard has seen the late tick. False when shut for good.
  bool open() noexcept {
    std::uint32_t shut = kShut;
    return state_.compare_exchange_strong(shut, 0, std::memory_order_acq_rel) || shut == 0;
  }

  /// As shut(), for ever: open() fails from now on. Safe in a signal handler.
  void shut_for_good() noexcept { state_.fetch_or(kShut | kForGood, std::memory_order_acq_rel); }

  [[nodiscard]] bool is_shut() const noexcept {
    return (state_.load(std::memory_order_acquire) & kShut) != 0;
  }
  [[nodiscard]] bool is_shut_for_good() const noexcept {
    return (state_.load(std::memory_order_acquire) & kForGood) != 0;
  }

 private:
  static constexpr std::uint32_t kInside = 1, kShut = 2, kForGood = 4;
  static_assert(std::atomic<std::uint32_t>::is_always_lock_free, "signal handlers rely on it");

  std::atomic<std::uint32_t> state_{0};
};

/// What a signal handler calls: shuts the gate for good, then writes zero. The function is the
/// device's, and must be async-signal-safe (one write(2) of a frame made beforehand, no lock, no
/// allocation). Install one in a static place before the force engages.
class LastZero {
 public:
  using WriteZero = void (*)(void* device) noexcept;

  /// `gate` and `device` must outlive every call of fire(). Not safe in a signal handler. nullptr
  /// as `write_zero` disarms.
  void arm(ForceGate& gate, WriteZero write_zero, void* device) noexcept {
    write_zero_.store(nullptr, std::memory_order_release);
    gate_.store(&gate, std::memory_order_relaxed);
    device_.store(device, std::memory_order_relaxed);
    write_zero_.store(write_zero, std::memory_order_release);
  }

  /// From a signal handler, std::terminate, a destructor; again and again if need be.
  void fire() noexcept {
    const WriteZero write_zero = write_zero_.load(std::memory_order_acquire);
    if (write_zero == nullptr) return;
    gate_.load(std::memory_order_relaxed)->shut_for_good();
    write_zero(device_.load(std::memory_order_relaxed));
  }

 private:
  static_assert(std::atomic<WriteZero>::is_always_lock_free &&
                std::atomic<void*>::is_always_lock_free);

  std::atomic<WriteZero> write_zero_{nullptr};
  std::atomic<ForceGate*> gate_{nullptr};
  std::atomic<void*> device_{nullptr};
};

}  // namespace clay::falcon
