#pragma once
// Connects a FalconModel as a transport, within the process.

#include "claystack/falcon/device.hpp"
#include "claystack/falcon/sim.hpp"
#include "falcon/sim/falcon_model.hpp"

#include <array>
#include <atomic>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <string>

namespace clay::falcon::inline sim {

/// Latency timer and two frames at 1.5 Mbaud, rounded to the known rate of a Falcon.
inline constexpr std::int64_t kFalconAnswerUs = 1'000;

class LoopbackTransport final : public Transport {
 public:
  /// Shares the model with its other owners, who may inspect it and plan faults between calls.
  LoopbackTransport(std::shared_ptr<FalconModel> model, SimClock clock);
  /// From now on answers come after this time.
  void answer_after(std::int64_t answer_us) noexcept { answer_us_ = answer_us; }

  [[nodiscard]] std::string describe() const override { return "simulated"; }
  [[nodiscard]] bool loads_firmware() const noexcept override { return true; }
  DeviceResult<void> open() override;
  void close() noexcept override;
  DeviceResult<void> set_mode(LineMode mode) override;
  WireStatus write(std::span<const std::uint8_t> bytes) noexcept override;
  Received read(std::span<std::uint8_t> bytes, std::int64_t wait_us) noexcept override;
  void write_last(std::span<const std::uint8_t> bytes) noexcept override;
  [[nodiscard]] std::int64_t now_us() const noexcept override;

 private:
  struct OnTheWay {
    std::int64_t ready_us = 0;
    Answer answer;
    std::size_t taken = 0;
  };
  [[nodiscard]] OnTheWay& first() noexcept { return queue_[first_ % queue_.size()]; }
  void wait_until(std::int64_t time_us) noexcept;
  [[nodiscard]] bool hold_model() noexcept;
  void release_model(bool held) noexcept;

  std::shared_ptr<FalconModel> model_;
  SimClock clock_;
  std::int64_t answer_us_ = kFalconAnswerUs;
  std::atomic<bool> model_held_{false};  // by `write` or `write_last`
  std::atomic<bool> open_{false};
  std::int64_t stepped_us_ = 3'600'000'000;  // an hour: the clock of a computer is not near 0
  std::int64_t asked_us_ = 0;
  std::array<OnTheWay, 64> queue_{};  // a ring: from first_, size_ of them
  std::size_t first_ = 0, size_ = 0;
};

}  // namespace clay::falcon::inline sim
