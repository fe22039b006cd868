#pragma once
// A byte-exact simulation of a Falcon: boot loader, homing, frames, a moving grip, and faults on
// demand. It serves LoopbackTransport and the emulated USB device of the tests. It was written from
// the same notes as the driver, so its fidelity is limited to docs/devices.md.

#include "claystack/falcon/sim.hpp"
#include "falcon/device/frame.hpp"
#include "falcon/device/kinematics.hpp"

#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <glm/vec3.hpp>
#include <span>
#include <utility>
#include <vector>

namespace clay::falcon::inline sim {

/// Moves the modelled grip. Called once per frame with the commanded force [N] and the time [s]
/// since the last frame; returns the position [mm] in the frame of Kinematics.
using Grip = std::function<glm::dvec3(const glm::dvec3& force_n, double dt_s)>;
/// Presses its buttons: called once per frame, after Grip; returns their bits.
using Thumb = std::function<std::uint8_t()>;

/// The model's answer to a write of at most kMostWritten bytes.
struct Answer {
  std::array<std::uint8_t, 128> bytes{};
  std::size_t size = 0;

  void add(std::span<const std::uint8_t> more) noexcept;
  [[nodiscard]] std::span<const std::uint8_t> span() const noexcept {
    return std::span(bytes).first(size);
  }
};

/// Allocates while firmware is loaded, never in `running`.
class FalconModel {
 public:
  FalconModel(FalconModelSettings settings, Grip grip);

  // The line, as the USB-UART sets it.
  void set_baud(int baud) noexcept { baud_ = baud; }
  void set_dtr(bool high) noexcept;  ///< a rising edge restarts the processor (assumption)

  /// Bytes from the host, `dt_s` since the last ones.
  [[nodiscard]] Answer receive(std::span<const std::uint8_t> bytes, double dt_s);

  /// A frame from the host's signal handler: it is executed but not answered.
  void receive_last(std::span<const std::uint8_t> frame) noexcept;

  [[nodiscard]] bool unplugged() const noexcept { return unplugged_; }
  void unplug() noexcept { unplugged_ = true; }
  /// Reconnected: the processor starts without a program.
  void replug() noexcept;

  void switch_power(bool on) noexcept;
  void press(std::uint8_t buttons) noexcept { settings_.buttons = buttons; }
  void hold(Thumb thumb) { thumb_ = std::move(thumb); }
  void plan(const PlannedFault& fault) { settings_.faults.push_back(fault); }

  [[nodiscard]] bool runs() const noexcept { return stage_ == Stage::running; }
  [[nodiscard]] bool homed() const noexcept { return homed_legs_ == 3; }
  [[nodiscard]] std::uint64_t frames() const noexcept { return frames_; }
  [[nodiscard]] const std::vector<std::uint8_t>& firmware() const noexcept { return firmware_; }
  /// The last motor command, and its force [N].
  [[nodiscard]] const LegCounts& motors() const noexcept { return motors_; }
  [[nodiscard]] const glm::dvec3& force_n() const noexcept { return force_n_; }
  [[nodiscard]] const glm::dvec3& position_mm() const noexcept { return position_mm_; }

 private:
  enum class Stage { waiting, greeted, loading, running };

  void restart(Stage stage) noexcept;
  void boot(std::uint8_t byte, Answer& answer);
  void load(std::uint8_t byte, Answer& answer);
  void run(std::uint8_t byte, double dt_s, Answer& answer);
  void answer_frame(double dt_s, Answer& answer);
  void home(bool asked) noexcept;
  [[nodiscard]] glm::dvec3 force_of(const LegCounts& motors) const noexcept;
  [[nodiscard]] FrameBytes state_frame() const;
  [[nodiscard]] bool take(std::uint8_t byte) noexcept;
  [[nodiscard]] bool happens(WireFault fault, std::uint64_t now);

  FalconModelSettings settings_;
  Grip grip_;
  Thumb thumb_;  // empty: `press`
  Kinematics kinematics_;
  Stage stage_ = Stage::waiting;
  int baud_ = baud_of(LineMode::greeting);
  bool dtr_ = true;
  bool unplugged_ = false;
  FrameBytes heard_{};  // of a greeting or a frame
  std::size_t heard_size_ = 0;
  std::vector<std::uint8_t> firmware_;
  FrameBytes last_frame_{};
  std::uint64_t frames_ = 0;
  int homing_ = 0;
  int homed_legs_ = 0;
  LegCounts motors_{}, counts_{};
  glm::dvec3 force_n_{0.0}, position_mm_{kFalconCentreMm};
};

}  // namespace clay::falcon::inline sim
