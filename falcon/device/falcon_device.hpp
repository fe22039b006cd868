#pragma once
// A Novint Falcon on any transport: start-up, homing, frames, kinematics.
//
//   closed --open--> needs_firmware --load--> needs_homing --the user--> ready
//                         ^                        ^                       |
//                     no answer                    +----- homing lost -----+
//   any of them --unplugged, or silent for long--> fault --open--> ...

#include "claystack/falcon/falcon_device.hpp"
#include "falcon/device/frame.hpp"
#include "falcon/device/kinematics.hpp"

#include <atomic>
#include <cstdint>
#include <glm/vec3.hpp>
#include <memory>
#include <span>

namespace clay::falcon::inline device {

class FalconDevice final : public HapticDevice {
 public:
  FalconDevice(std::unique_ptr<Transport> line, const FalconSettings& settings);
  ~FalconDevice() override;

  [[nodiscard]] const DeviceInfo& info() const noexcept override { return info_; }
  DeviceResult<void> open() override;
  DeviceSample read(std::int64_t wait_us) noexcept override;
  void write(const glm::dvec3& force_n) noexcept override;
  void zero() noexcept override;
  void stop() noexcept override;
  [[nodiscard]] DeviceError problem() const override;
  [[nodiscard]] DeviceCounters counters() const noexcept override;

 private:
  DeviceResult<void> check_settings() const;
  DeviceResult<void> start();
  DeviceResult<bool> answers();
  [[nodiscard]] std::int64_t ask_and_wait() noexcept;
  [[nodiscard]] std::int64_t answer_time_us() noexcept;
  void take(std::span<const std::uint8_t> bytes, std::int64_t time_us) noexcept;
  void accept(const StateFrame& frame, std::int64_t time_us) noexcept;
  void fail(DeviceFault fault) noexcept;
  [[nodiscard]] LegCounts motors_for(const glm::dvec3& force_n) const noexcept;

  std::unique_ptr<Transport> line_;
  FalconSettings settings_;
  Kinematics kinematics_;
  DeviceInfo info_;
  DeviceError refusal_;  // of the last `open`
  DeviceFault fault_ = DeviceFault::no_answer;
  FrameReader reader_;
  DeviceSample sample_;
  glm::dvec3 position_mm_;                // in the frame of the kinematics
  std::int64_t unanswered_since_us_ = 0;  // the first write after the last frame; 0: none
  DeviceCounters counters_;
  std::atomic<bool> stopped_{false};
};

}  // namespace clay::falcon::inline device
