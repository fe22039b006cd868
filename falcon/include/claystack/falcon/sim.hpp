#pragma once
#include "claystack/falcon/device.hpp"
#include "claystack/falcon/falcon_device.hpp"
#include "claystack/falcon/passivity.hpp"

#include <array>
#include <atomic>
#include <cstdint>
#include <functional>
#include <glm/vec3.hpp>
#include <memory>
#include <optional>
#include <tl/expected.hpp>

namespace clay::falcon::inline sim {

// ---- loopback transport --------------------------------------------------------------
// Connects a FalconModel as a transport, within the process.

enum class Pace {
  real,     ///< answers come one millisecond after the question, by CLOCK_MONOTONIC
  virtual_  ///< the same on a clock that only waiting advances: a second takes microseconds
};

class LoopbackTransport final : public Transport {
 public:
  /// The model outlives this; its owner may inspect it and plan faults between calls.
  LoopbackTransport(std::shared_ptr<FalconModel> model, Pace pace);

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
  void let_go(bool held) noexcept;

  std::shared_ptr<FalconModel> model_;
  Pace pace_;
  std::atomic<bool> model_held_{false};  // by `write` or `write_last`
  std::atomic<bool> open_{false};
  std::int64_t virtual_us_ = 3'600'000'000;  // an hour: clocks of computers are not near 0
  std::int64_t asked_us_ = 0;
  std::array<OnTheWay, 64> queue_{};  // a ring: from first_, size_ of them
  std::size_t first_ = 0, size_ = 0;
};

// ---- simulated arm -------------------------------------------------------------------
// A simulated arm: a mass on three independent axes with damping, friction, encoder steps, a force
// that arrives late and is held for one period, and a hand. For tests and demos. Between two
// readings it moves by closed-form solution, so the result is exact at every rate.
//
//   m x'' = F_held - b x' - f sign(x') + hand,     hand = push + k_h (s - x) + b_h (s' - x')
//
// Units: mm, s, N, mJ; the mass alone is in kg.

struct ArmSpec {
  SampledLoop loop;         ///< rate, m, b and delay
  double friction_n = 0.0;  ///< f, Coulomb: of each axis
  double step_mm = 0.0;     ///< encoder step: readings are whole multiples; 0: continuous
};

/// A hand pulls towards its intended point s, and pushes.
struct HandSpec {
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
  /// Starts at rest at `start_mm`. Refuses what `check` of the loop refuses, friction outside 0 to
  /// 100 N, steps outside 0 to 10 mm, a hand stiffer than 1000 N/mm, damped more than 10 N s/mm or
  /// pushing more than 100 N, and a start beyond 10 m.
  static tl::expected<SimulatedArm, OutOfRange> build(const ArmSpec& arm, const HandSpec& hand = {},
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
  [[nodiscard]] const ArmSpec& spec() const noexcept { return spec_; }

 private:
  struct Coefficients;
  static constexpr int kMostDelay = 8;

  SimulatedArm(const ArmSpec& arm, const HandSpec& hand, const glm::dvec3& start_mm) noexcept;
  [[nodiscard]] glm::dvec3 late(const glm::dvec3& force_n) noexcept;

  ArmSpec spec_;
  HandSpec hand_;
  std::shared_ptr<const Coefficients> tick_;  // of a whole period, for each axis
  glm::dvec3 position_{0.0}, velocity_{0.0}, intended_{0.0};
  glm::dvec3 on_the_way_[kMostDelay]{};  // forces sent and not yet held, a ring
  int next_ = 0;
  ArmEnergy energy_;
};

// ---- simulated falcon ----------------------------------------------------------------
// A whole Falcon without hardware: a SimulatedArm as the grip of a FalconModel, behind a
// LoopbackTransport and the real driver. For demos and tests; `auto` never selects it.

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

struct SimulatedSettings {
  ArmSpec arm;
  HandSpec hand{glm::dvec3(0.0), glm::dvec3(0.3), glm::dvec3(0.003)};
  HandPath path = idle_circle_mm;
  HandFingers fingers;
  FalconModelSettings model;  ///< faults; `loaded`: its firmware is present
  FalconSettings falcon;
  Pace pace = Pace::real;
};

struct SimulatedFalcon {
  std::unique_ptr<HapticDevice> device;  ///< closed
  std::shared_ptr<FalconModel> model;    ///< the other end of the wire, for faults on demand
  const Transport* line = nullptr;       ///< the device's transport, for its clock
};

/// The arm follows the times of the frames: it makes one tick per period that has passed, at most
/// 50 ms of them after a pause. Buttons are sent over the wire; a Falcon measures no grip, so the
/// grip value bypasses the wire, with the same frame. `bad_setting` names what SimulatedArm
/// refuses.
[[nodiscard]] DeviceResult<SimulatedFalcon> make_simulated_falcon(
    const SimulatedSettings& settings);

/// Settings of a Falcon that is ready for homing.
[[nodiscard]] SimulatedSettings simulated_and_loaded();

}  // namespace clay::falcon::inline sim
