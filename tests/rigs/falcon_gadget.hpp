#pragma once
// A USB Falcon: an FTDI chip in front of a FalconModel.

#include "falcon/sim/falcon_model.hpp"
#include "tests/rigs/usb_gadget.hpp"

#include <deque>
#include <functional>
#include <glm/vec3.hpp>
#include <string>
#include <vector>

namespace clay::rig {

/// The grip position set by the hand at each frame [mm], in the frame of Kinematics.
using Trajectory = std::function<glm::dvec3(std::uint64_t frame)>;

/// The values that one frame set: the position, the force and the motors.
struct FrameLog {
  glm::dvec3 position_mm;
  glm::dvec3 force_n;
  falcon::LegCounts motors;
};

/// A model whose grip follows the hand regardless of the motors, with a log.
class HandledModel {
 public:
  HandledModel(const falcon::FalconModelSettings& settings, Trajectory hand);
  falcon::FalconModel model;
  std::vector<FrameLog> log;
};

class FalconGadget : public UsbGadget {
 public:
  FalconGadget(const falcon::FalconModelSettings& settings, Trajectory hand);

  [[nodiscard]] const UsbIdentity& identity() const override { return identity_; }
  std::optional<Bytes> control(const Setup& setup, std::span<const std::uint8_t> data) override;
  void out(std::span<const std::uint8_t> bytes) override;
  std::optional<Bytes> in(std::size_t room, std::chrono::microseconds waited) override;
  bool unplugged() const override { return device.model.unplugged(); }

  HandledModel device;
  int latency_ms = 16;               ///< set by the host
  std::vector<int> bauds;            ///< all baud rates set by the host
  std::uint64_t control_errors = 0;  ///< requests that no FTDI driver makes

 private:
  UsbIdentity identity_;
  std::deque<std::uint8_t> fifo_;  // from the processor to the host
};

}  // namespace clay::rig
