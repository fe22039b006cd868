#pragma once
// A whole Falcon without hardware: a SimulatedArm as the grip of a FalconModel, behind a
// LoopbackTransport and the driver of the real one. For demos and tests; `auto` never picks it.

#include "claystack/falcon/falcon_device.hpp"
#include "claystack/falcon/falcon_model.hpp"
#include "claystack/falcon/loopback_transport.hpp"
#include "claystack/falcon/simulated_arm.hpp"

#include <functional>
#include <glm/vec3.hpp>
#include <memory>
#include <optional>

namespace clay::falcon {

/// Where the hand means to be [mm], in the device frame, at a time [s] since the device was made.
using HandPath = std::function<glm::dvec3(double time_s)>;

/// A circle of 20 mm about the origin, in the plane that the user faces, a turn in four seconds.
[[nodiscard]] glm::dvec3 idle_circle_mm(double time_s);

/// What a hand does beside moving.
struct Fingers {
  std::uint8_t buttons = 0;                      ///< as DeviceSample has them
  std::optional<double> grip_mm = std::nullopt;  ///< of a hand that holds something
  friend bool operator==(const Fingers&, const Fingers&) = default;
};
/// At a time [s] as that of HandPath; no function: nothing is pressed and nothing held.
using HandFingers = std::function<Fingers(double time_s)>;

struct SimulatedSettings {
  ArmSpec arm;
  HandSpec hand{glm::dvec3(0.0), glm::dvec3(300.0), glm::dvec3(3.0)};
  HandPath path = idle_circle_mm;
  HandFingers fingers;
  FalconModelSettings model;  ///< faults; its firmware is there when `loaded`
  FalconSettings falcon;
  Pace pace = Pace::real;
};

struct SimulatedFalcon {
  std::unique_ptr<HapticDevice> device;  ///< closed
  std::shared_ptr<FalconModel> model;    ///< the other end of the wire, for faults on demand
  const Transport* line = nullptr;       ///< the device's, for its clock
};

/// The arm lives by the frames' times: it makes as many of its ticks as have passed, at most 50 ms
/// of them after a pause. Buttons come over the wire; a Falcon measures no grip, so that comes
/// beside it, as of the same frame. `bad_setting` names what SimulatedArm refuses.
[[nodiscard]] DeviceResult<SimulatedFalcon> make_simulated_falcon(
    const SimulatedSettings& settings);

/// Settings of one that is ready for the user to home it.
[[nodiscard]] SimulatedSettings simulated_and_loaded();

}  // namespace clay::falcon
