#pragma once
// A Falcon that isn't there, byte for byte: boot loader, homing, frames, a grip that moves, and
// faults on demand. It stands behind LoopbackTransport and behind the emulated USB device of the
// tests. What it says of the real one's manner is only as good as docs/devices.md: it was written
// from the same notes as the driver.

#include "claystack/falcon/frame.hpp"
#include "claystack/falcon/kinematics.hpp"

#include <array>
#include <cstdint>
#include <functional>
#include <glm/vec3.hpp>
#include <span>
#include <utility>
#include <vector>

namespace clay::falcon {

/// What moves the modelled grip. Called once a frame with the force [N] that the motors were told
/// and the time [s] since the last frame; returns the position [m] in the frame of kinematics.hpp.
using Grip = std::function<glm::dvec3(const glm::dvec3& force_n, double dt_s)>;
/// What presses its buttons: called once a frame, after Grip; returns their bits.
using Thumb = std::function<std::uint8_t()>;

enum class WireFault {
  lost_byte,    ///< of the frame it sends
  extra_byte,   ///< within the frame
  half_frame,   ///< the second half never comes
  bad_nibble,   ///< a byte that is no letter
  no_frame,     ///< it does not answer
  stale_frame,  ///< it sends what it sent before
  homing_lost,  ///< from here on, until it is homed again
  unplugged,
  echo_error,  ///< a byte of the firmware comes back changed
};

/// At a frame, counted from 0 since the first was received; for echo_error at a byte of firmware.
/// Each happens once, at the first chance from there on.
struct PlannedFault {
  WireFault fault = WireFault::lost_byte;
  std::uint64_t at = 0;
};

struct FalconModelSettings {
  Geometry geometry = kLibnifalconGeometry;
  double motor_counts_per_nm = kMotorCountsPerNm;
  bool power = true;    ///< off: USB enumerates, and nothing answers
  bool loaded = false;  ///< firmware is there from an earlier start
  bool homed = false;
  int homing_frames = 20;  ///< frames with the homing bit until a leg is homed, one by one
  std::int16_t unhomed_offset = -300;  ///< of the encoders until then
  std::uint8_t buttons = 0;
  std::vector<PlannedFault> faults;
};

/// What the model says to a piece of at most kMostWritten bytes.
struct Answer {
  std::array<std::uint8_t, 128> bytes{};
  std::size_t size = 0;

  void add(std::span<const std::uint8_t> more) noexcept;
  [[nodiscard]] std::span<const std::uint8_t> span() const noexcept {
    return std::span(bytes).first(size);
  }
};

/// Allocates while firmware is loaded, and never in `running`.
class FalconModel {
 public:
  FalconModel(FalconModelSettings settings, Grip grip);

  // The line, as the USB-UART sets it.
  void set_baud(int baud) noexcept { baud_ = baud; }
  void set_dtr(bool high) noexcept;  ///< a rise restarts the processor: a guess

  /// Bytes from the host, `dt_s` since the last ones.
  [[nodiscard]] Answer receive(std::span<const std::uint8_t> bytes, double dt_s);

  /// A frame from the host's signal handler: it is obeyed and not answered.
  void receive_last(std::span<const std::uint8_t> frame) noexcept;

  [[nodiscard]] bool unplugged() const noexcept { return unplugged_; }
  void unplug() noexcept { unplugged_ = true; }
  /// Plugged in again: the processor starts from nothing.
  void replug() noexcept;

  void switch_power(bool on) noexcept;
  void press(std::uint8_t buttons) noexcept { settings_.buttons = buttons; }
  void hold(Thumb thumb) { thumb_ = std::move(thumb); }
  void plan(const PlannedFault& fault) { settings_.faults.push_back(fault); }

  [[nodiscard]] bool runs() const noexcept { return stage_ == Stage::running; }
  [[nodiscard]] bool homed() const noexcept { return homed_legs_ == 3; }
  [[nodiscard]] std::uint64_t frames() const noexcept { return frames_; }
  [[nodiscard]] const std::vector<std::uint8_t>& firmware() const noexcept { return firmware_; }
  /// What the motors were told last, and the force [N] that it makes.
  [[nodiscard]] const LegCounts& motors() const noexcept { return motors_; }
  [[nodiscard]] const glm::dvec3& force_n() const noexcept { return force_n_; }
  [[nodiscard]] const glm::dvec3& position_m() const noexcept { return position_m_; }

 private:
  enum class Stage { waiting, greeted, loading, running };

  void restart(Stage stage) noexcept;
  void boot(std::uint8_t byte, Answer& answer);
  void load(std::uint8_t byte, Answer& answer);
  void run(std::uint8_t byte, double dt_s, Answer& answer);
  void answer_frame(double dt_s, Answer& answer);
  void home(bool asked) noexcept;
  [[nodiscard]] glm::dvec3 force_of(const LegCounts& motors) const noexcept;
  [[nodiscard]] std::array<std::uint8_t, kFrameBytes> state_frame() const;
  [[nodiscard]] bool take(std::uint8_t byte) noexcept;
  [[nodiscard]] bool happens(WireFault fault, std::uint64_t now);

  FalconModelSettings settings_;
  Grip grip_;
  Thumb thumb_;  // none: `press`
  Kinematics kinematics_;
  Stage stage_ = Stage::waiting;
  int baud_ = 9600;
  bool dtr_ = true;
  bool unplugged_ = false;
  std::array<std::uint8_t, kFrameBytes> heard_{};  // of a greeting or a frame
  std::size_t heard_size_ = 0;
  std::vector<std::uint8_t> firmware_;
  std::array<std::uint8_t, kFrameBytes> last_frame_{};
  std::uint64_t frames_ = 0;
  int homing_ = 0;
  int homed_legs_ = 0;
  LegCounts motors_{}, counts_{};
  glm::dvec3 force_n_{0.0}, position_m_{Kinematics::kCentreM};
};

}  // namespace clay::falcon
