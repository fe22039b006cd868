#pragma once
// A Novint Falcon on any transport: start-up, homing, frames, kinematics.
//
//   closed --open--> needs_firmware --load--> needs_homing --the user--> ready
//                         ^                        ^                       |
//                     no answer                    +----- homing lost -----+
//   any of them --unplugged, or silent for long--> fault --open--> ...

#include "claystack/falcon/device.hpp"
#include "claystack/falcon/frame.hpp"
#include "claystack/falcon/kinematics.hpp"
#include "claystack/falcon/transport.hpp"

#include <array>
#include <atomic>
#include <memory>
#include <string>

namespace clay::falcon {

struct FalconSettings {
  Geometry geometry = kLibnifalconGeometry;
  double motor_counts_per_nm = kMotorCountsPerNm;  ///< 1 to 1e6; more pushes harder
  glm::dvec3 centre_m = Kinematics::kCentreM;      ///< the origin of samples, in kinematics.hpp's
  double force_limit_n = 8.0;                      ///< 0 to 8.9, what Novint states
  std::int64_t silence_us = 500'000;               ///< without a frame this long: fault
  std::string firmware_path;                       ///< empty: it must be loaded already
};

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

  /// What the motors were last told; for logs.
  [[nodiscard]] const LegCounts& motors() const noexcept { return motors_; }

 private:
  DeviceResult<void> check_settings() const;
  DeviceResult<void> start();
  DeviceResult<bool> answers();
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
  glm::dvec3 position_m_;                 // in the frame of the kinematics
  std::int64_t unanswered_since_us_ = 0;  // the first write after the last frame; 0: none
  LegCounts motors_{};
  DeviceCounters counters_;
  std::atomic<bool> stopped_{false};
};

}  // namespace clay::falcon
