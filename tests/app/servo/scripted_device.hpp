#pragma once
// A device for tests with threads: it can hang, and logs the last command. The log is atomic, and
// two processes may share its memory.

#include "claystack/falcon/device.hpp"

#include <atomic>
#include <cmath>
#include <cstdint>
#include <thread>

namespace clay::servo {

struct WireLog {
  std::atomic<std::uint64_t> writes{0}, zeros{0}, stops{0};
  std::atomic<double> last_force_n{0.0};  ///< magnitude of the last commanded force
  std::atomic<double> max_force_n{0.0};
  std::atomic<bool> hang{false};  ///< reads do not return
  std::atomic<bool> gone{false};  ///< unplugged
};

class ScriptedDevice final : public falcon::HapticDevice {
 public:
  explicit ScriptedDevice(WireLog& log) : log_(log) {
    info_ = {"scripted", "nowhere", true, 8.0, glm::dvec3(48.0), 1000.0};
  }
  [[nodiscard]] const falcon::DeviceInfo& info() const noexcept override { return info_; }
  falcon::DeviceResult<void> open() override { return {}; }

  falcon::DeviceSample read(std::int64_t) noexcept override {
    while (log_.hang.load()) std::this_thread::yield();
    const std::int64_t now_us = falcon::monotonic_us();
    if (first_us_ == 0) first_us_ = now_us;
    const auto state = log_.gone.load() ? falcon::DeviceState::fault : falcon::DeviceState::ready;
    return {now_us, position_mm(1e-6 * static_cast<double>(now_us - first_us_)), 0, state, true};
  }
  void write(const glm::dvec3& force_n) noexcept override {
    if (stopped_.load()) return;
    const double n =
        std::sqrt(force_n.x * force_n.x + force_n.y * force_n.y + force_n.z * force_n.z);
    // First, because a test that sees the last force may end the process at once.
    if (n > log_.max_force_n.load()) log_.max_force_n.store(n);
    log_.last_force_n.store(n);
    ++log_.writes;
    if (stopped_.load()) log_.last_force_n.store(0.0);
  }
  void zero() noexcept override {
    log_.last_force_n.store(0.0);
    ++log_.zeros;
  }
  void stop() noexcept override {
    stopped_.store(true);
    log_.last_force_n.store(0.0);
    ++log_.stops;
  }
  [[nodiscard]] falcon::DeviceError problem() const override {
    return {falcon::DeviceFault::unplugged, "nowhere: unplugged", "plug it in again"};
  }
  [[nodiscard]] falcon::DeviceCounters counters() const noexcept override { return {}; }

 private:
  /// Starts off the clay, then presses in at 10 mm/s. Leaves the clay every three seconds, because
  /// the guard waits for that after a delay on a busy machine.
  static glm::dvec3 position_mm(double time_s) {
    const double t = std::fmod(time_s, 3.0);
    if (t > 2.5) return {std::fmin(2.0, -20.0 + 100.0 * (t - 2.5)), 0.0, 0.0};
    return {t < 0.1 ? 2.0 : std::fmax(-20.0, 1.0 - 10.0 * (t - 0.1)), 0.0, 0.0};
  }

  WireLog& log_;
  falcon::DeviceInfo info_;
  std::int64_t first_us_ = 0;
  std::atomic<bool> stopped_{false};
};

}  // namespace clay::servo
