#pragma once
#include "claystack/falcon/device.hpp"
#include "claystack/falcon/falcon_device.hpp"
#include "claystack/falcon/passivity.hpp"

#include <cstdint>
#include <functional>
#include <glm/vec3.hpp>
#include <memory>
#include <optional>
#include <tl/expected.hpp>
#include <vector>

namespace clay::falcon::inline sim {

// ---- simulated arm -------------------------------------------------------------------
// A simulated arm: a mass on three independent axes with damping, friction, encoder steps, a force
// that arrives late and is held for one period, and a hand. For tests and demos. Between two
// readings it moves by closed-form solution, so the result is exact at every rate.
//
//   m x'' = F_held - b x' - f sign(x') + hand,     hand = push + k_h (s - x) + b_h (s' - x')
//
// Units: mm, s, N, mJ; the mass alone is in kg.

struct ArmSettings {
  SampledLoop loop;         ///< rate, m, b and delay
  double friction_n = 0.0;  ///< f, Coulomb: of each axis
  double step_mm = 0.0;     ///< encoder step: readings are whole multiples; 0: continuous
};

/// A hand pulls towards its intended point s, and pushes.
struct HandSettings {
  glm::dvec3 push_n{0.0};
  glm::dvec3 stiffness_n_per_mm{0.0};  ///< k_h, of each axis
  glm::dvec3 damping_ns_per_mm{0.0};   ///< b_h
};

/// Work since the start, summed over the axes [mJ]. Balance: kinetic energy gained = displayed +
/// hand - damped - rubbed.
struct ArmEnergy {
  double displayed = 0.0;  ///< done on the arm by the held force
  double hand = 0.0;       ///< done on the arm by the hand
  double damped = 0.0;     ///< lost in b: the integral of b v^2
  double rubbed = 0.0;     ///< lost in friction
};

class SimulatedArm {
 public:
  /// Starts at rest at `start_mm`. Refuses the loops that `check` refuses, friction outside 0 to
  /// 100 N, steps outside 0 to 10 mm, a hand stiffer than 1000 N/mm, damped more than 10 N s/mm or
  /// pushing more than 100 N, and a start beyond 10 m.
  static tl::expected<SimulatedArm, OutOfRange> build(const ArmSettings& arm,
                                                      const HandSettings& hand = {},
                                                      const glm::dvec3& start_mm = {}) noexcept;

  /// The current encoder readings [mm].
  [[nodiscard]] glm::dvec3 reading_mm() const noexcept;

  /// Applies the force [N] that answers this reading for one period, while the hand's point moves
  /// to `intended_mm` at constant speed. An invalid force (not finite) counts as zero.
  void advance(const glm::dvec3& force_n, const glm::dvec3& intended_mm) noexcept;
  /// The same with the hand's point at rest.
  void advance(const glm::dvec3& force_n) noexcept { advance(force_n, intended_); }

  /// The same with an unyielding hand: the arm goes to `position_mm` at constant speed.
  void carry(const glm::dvec3& force_n, const glm::dvec3& position_mm) noexcept;

  [[nodiscard]] const glm::dvec3& position_mm() const noexcept { return position_; }
  [[nodiscard]] const glm::dvec3& velocity_mm_s() const noexcept { return velocity_; }
  [[nodiscard]] double kinetic_energy_mj() const noexcept;
  [[nodiscard]] const ArmEnergy& energy() const noexcept { return energy_; }
  [[nodiscard]] const ArmSettings& settings() const noexcept { return settings_; }

 private:
  struct Coefficients;

  SimulatedArm(const ArmSettings& arm, const HandSettings& hand,
               const glm::dvec3& start_mm) noexcept;
  [[nodiscard]] glm::dvec3 late(const glm::dvec3& force_n) noexcept;

  ArmSettings settings_;
  HandSettings hand_;
  std::shared_ptr<const Coefficients> tick_;  // of a whole period, for each axis
  glm::dvec3 position_{0.0}, velocity_{0.0}, intended_{0.0};
  glm::dvec3 on_the_way_[kMostDelayTicks]{};  // forces sent and not yet held, a ring
  int next_ = 0;
  ArmEnergy energy_;
};

// ---- simulated falcon ----------------------------------------------------------------
// A whole Falcon without hardware: a SimulatedArm as the grip of a model of its processor, behind
// the real driver. For demos and tests; `auto` never selects it.

/// The hand's intended point [mm], in the device frame, at a time [s] since the device was made.
using HandPath = std::function<glm::dvec3(double time_s)>;

/// A circle of radius 20 mm about the origin in the plane facing the user, one turn in four
/// seconds.
[[nodiscard]] glm::dvec3 idle_circle_mm(double time_s);

/// Input of the hand beside motion.
struct Fingers {
  std::uint8_t buttons = 0;                      ///< as DeviceSample has them
  std::optional<double> grip_mm = std::nullopt;  ///< set if the hand holds something
  friend bool operator==(const Fingers&, const Fingers&) = default;
};
/// At the time [s] of HandPath; without a function no button is pressed and nothing is held.
using HandFingers = std::function<Fingers(double time_s)>;

/// A fault of the model.
enum class WireFault {
  lost_byte,    ///< of the frame it sends
  extra_byte,   ///< within the frame
  half_frame,   ///< the second half is not sent
  bad_nibble,   ///< a byte that is not a payload letter
  no_frame,     ///< it does not answer
  stale_frame,  ///< it repeats an earlier frame
  homing_lost,  ///< from here on, until homed again
  unplugged,
  echo_error,  ///< one byte of the firmware echo is changed
};

/// Happens once, at the first opportunity from that frame on, counted from 0 since the first frame
/// received; for echo_error at that byte of the firmware.
struct PlannedFault {
  WireFault fault = WireFault::lost_byte;
  std::uint64_t at = 0;
};

/// The model of a Falcon: its state at the start, and its faults.
struct FalconModelSettings {
  Geometry geometry = kLibnifalconGeometry;
  double motor_counts_per_nmm = kMotorCountsPerNmm;
  bool power = true;    ///< false: USB enumerates, but the device does not answer
  bool loaded = false;  ///< firmware is present from an earlier start
  bool homed = false;
  /// Frames with the homing bit per leg, one leg after the other; at least 1.
  int homing_frames = 20;
  std::int16_t unhomed_offset = -300;  ///< of the encoders until then
  std::uint8_t buttons = 0;
  std::vector<PlannedFault> faults;
};

/// The time in which a simulated Falcon answers, one millisecond after each question.
enum class SimClock {
  real,    ///< CLOCK_MONOTONIC
  stepped  ///< advanced only by waiting for an answer: a second takes microseconds
};

struct SimulatedSettings {
  ArmSettings arm;
  HandSettings hand{glm::dvec3(0.0), glm::dvec3(0.3), glm::dvec3(0.003)};
  HandPath path = idle_circle_mm;
  HandFingers fingers;
  FalconModelSettings model;  ///< faults; `loaded`: its firmware is present
  FalconSettings falcon;
  SimClock clock = SimClock::real;
};

struct SimulatedFalcon {
  std::unique_ptr<HapticDevice> device;  ///< closed
  const Transport* line = nullptr;       ///< the device's transport, for its clock
};

/// The arm follows the times of the frames: it makes one tick per period that has passed, at most
/// 50 ms of them after a pause. Buttons are sent over the wire; a Falcon measures no grip, so the
/// grip value bypasses the wire, with the same frame. `bad_setting` names the setting that
/// SimulatedArm refuses.
[[nodiscard]] DeviceResult<SimulatedFalcon> make_simulated_falcon(
    const SimulatedSettings& settings);

/// Settings of a Falcon that is ready for homing.
[[nodiscard]] SimulatedSettings simulated_and_loaded();

}  // namespace clay::falcon::inline sim
