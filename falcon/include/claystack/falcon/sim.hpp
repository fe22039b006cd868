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
// A FalconModel as a transport, within the process.

enum class Pace {
  real,     ///< answers come a millisecond after the question, by CLOCK_MONOTONIC
  virtual_  ///< the same on a clock that only waiting moves: a second takes microseconds
};

class LoopbackTransport final : public Transport {
 public:
  /// The model outlives this; its owner may look at it and plan faults between calls.
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
  std::int64_t virtual_us_ = 1;
  std::int64_t asked_us_ = 0;
  std::array<OnTheWay, 64> queue_{};  // a ring: from first_, size_ of them
  std::size_t first_ = 0, size_ = 0;
};

// ---- simulated arm -------------------------------------------------------------------
// An arm that isn't there: a mass on three independent axes, with damping, friction, encoders that
// step, a force that comes late and is held for a period, and a hand. For tests and demos. Between
// two readings it moves by formula, so it is right at every rate.
//
//   m x'' = F_held - b x' - f sign(x') + hand,     hand = push + k_h (s - x) + b_h (s' - x')
//
// SI units throughout: m, s, kg, N, J.

struct ArmSpec {
  SampledLoop loop;         ///< rate, m, b and delay
  double friction_n = 0.0;  ///< f, Coulomb: of each axis
  double step_m = 0.0;      ///< of the encoders: readings are whole multiples; 0: they don't step
};

/// A hand pulls towards a point s that it means to be at, and pushes.
struct HandSpec {
  glm::dvec3 push_n{0.0};
  glm::dvec3 stiffness_n_per_m{0.0};  ///< k_h, of each axis
  glm::dvec3 damping_ns_per_m{0.0};   ///< b_h
};

/// Work since the start, summed over the axes [J]. It balances: the kinetic energy gained is
/// displayed + hand - damped - rubbed.
struct ArmEnergy {
  double displayed = 0.0;  ///< done on the arm by the force as it was held
  double hand = 0.0;       ///< done on the arm by the hand
  double damped = 0.0;     ///< lost in b: the integral of b v^2
  double rubbed = 0.0;     ///< lost in friction
};

class SimulatedArm {
 public:
  /// At rest at `start_m`. Refuses what `check` of the loop refuses, friction outside 0 to 100 N,
  /// steps outside 0 to 0.01 m, a hand stiffer than 1e6 N/m, damped more than 1e4 N s/m, pushing
  /// more than 100 N, or a start beyond 10 m.
  static tl::expected<SimulatedArm, OutOfRange> build(const ArmSpec& arm, const HandSpec& hand = {},
                                                      const glm::dvec3& start_m = {}) noexcept;

  /// What the encoders say now [m].
  [[nodiscard]] glm::dvec3 reading_m() const noexcept;

  /// Takes the force [N] that answers this reading, and lets one period pass. The hand's point goes
  /// to `intended_m` at constant speed meanwhile. A force that is not finite is taken as none.
  void advance(const glm::dvec3& force_n, const glm::dvec3& intended_m) noexcept;
  /// The same with the hand's point where it is.
  void advance(const glm::dvec3& force_n) noexcept { advance(force_n, intended_); }

  /// The same with a hand that can't be resisted: the arm goes to `position_m` at constant speed.
  void carry(const glm::dvec3& force_n, const glm::dvec3& position_m) noexcept;

  [[nodiscard]] const glm::dvec3& position_m() const noexcept { return position_; }
  [[nodiscard]] const glm::dvec3& velocity_m_s() const noexcept { return velocity_; }
  [[nodiscard]] double kinetic_energy_j() const noexcept;
  [[nodiscard]] const ArmEnergy& energy() const noexcept { return energy_; }
  [[nodiscard]] const ArmSpec& spec() const noexcept { return spec_; }

 private:
  struct Coefficients;
  static constexpr int kMostDelay = 8;

  SimulatedArm(const ArmSpec& arm, const HandSpec& hand, const glm::dvec3& start_m) noexcept;
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
// LoopbackTransport and the driver of the real one. For demos and tests; `auto` never picks it.

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

}  // namespace clay::falcon::inline sim
