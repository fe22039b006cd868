#pragma once
#include "claystack/falcon/device.hpp"

#include <array>
#include <atomic>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <glm/mat3x2.hpp>
#include <glm/mat3x3.hpp>
#include <glm/vec3.hpp>
#include <memory>
#include <numbers>
#include <optional>
#include <span>
#include <string>
#include <tl/expected.hpp>
#include <utility>
#include <vector>

namespace clay::falcon::inline device {

// ---- geometry ------------------------------------------------------------------------
// Dimensions of the Novint Falcon. No accurate measurement is published: the two
// published sets differ by up to 10 mm in the grip's z, so absolute position is uncertain by that
// much. Motion relative to a start is not.

/// Directions of the top, right and left leg about the z axis, from x [rad]: 105, -15, -135 deg.
inline constexpr double kLegDirectionsRad[] = {std::numbers::pi * 7 / 12, -std::numbers::pi / 12,
                                               -std::numbers::pi * 3 / 4};

/// One leg (all three are equal); letters as in Stamper's thesis (see Kinematics).
struct Geometry {
  double thigh_mm;         ///< a: hip to knee
  double shin_mm;          ///< b: side of the shin's parallelogram
  double shin_ends_mm;     ///< d + e: from knee and grip to the parallelogram's corners
  double base_radial_mm;   ///< r: centre to hip, along the leg's direction
  double base_lateral_mm;  ///< s: the same, perpendicular to it
  double grip_radial_mm;   ///< c: grip centre to its joint, along the leg's direction
  double grip_lateral_mm;  ///< f: the same, perpendicular to it
  double gear_ratio;       ///< motor turns per turn of the thigh
  double zero_angle_rad;   ///< thigh angle at encoder count 0
};

/// libnifalcon, FalconGeometry.h.
inline constexpr Geometry kLibnifalconGeometry = {
    .thigh_mm = 60.0,
    .shin_mm = 102.5,
    .shin_ends_mm = 2 * 11.25,
    .base_radial_mm = 40.0,
    .base_lateral_mm = -23.09,
    .grip_radial_mm = 14.43,
    .grip_lateral_mm = -25.0,
    .gear_ratio = 0.110 / 0.01425,
    .zero_angle_rad = std::numbers::pi * 35 / 180,
};

/// Martin and Hillier, "Characterisation of the Novint Falcon haptic device for application as a
/// robot manipulator", ACRA 2009. The zero angle is the one reported by users of this set.
inline constexpr Geometry kMartinHillierGeometry = {
    .thigh_mm = 60.0,
    .shin_mm = 102.5,
    .shin_ends_mm = 2 * 11.5,
    .base_radial_mm = 36.6,
    .base_lateral_mm = 27.2,
    .grip_radial_mm = 15.7,
    .grip_lateral_mm = 26.2,
    .gear_ratio = 7.62,
    .zero_angle_rad = std::numbers::pi * 40 / 180,
};

/// 320 slots of the encoder wheel, each counted four times in quadrature.
inline constexpr double kCountsPerMotorTurn = 320 * 4;

/// Motor counts for 1 N mm at the thigh: Martin and Hillier measured 0.019835 N mm per count at the
/// motor, which agrees with the force Novint states. libnifalcon's 10 renders 1.5 times as much.
inline constexpr double kMotorCountsPerNmm = 1.0 / (0.019835 * 7.62);

// ---- frame ---------------------------------------------------------------------------
// The Falcon's run-time frame, 16 bytes out and 16 back:
//
//   0    1..4   5..8   9..12   13      14      15
//   '<'  top    right  left    status  unused  '>'
//
// Every payload byte is its value + 'A'. A leg's number is an int16, one nibble per byte, least
// significant first: -1447 = 0xFA59 is "JFKP".

inline constexpr std::size_t kFrameBytes = 16;
inline constexpr std::int16_t kMotorLimit = 4095;  ///< where the vendor's driver saturates

/// One number for each leg: top, right, left, as the user sees them.
using LegCounts = std::array<std::int16_t, 3>;

/// Frame from the host.
struct MotorFrame {
  LegCounts motors{};   ///< within +-kMotorLimit
  bool homing = false;  ///< set in every frame until all legs are homed
  bool green = false;
  bool blue = false;
  bool red = false;
};

struct EncodedFrame {
  std::array<std::uint8_t, kFrameBytes> bytes{};
  bool saturated =
      false;  ///< a motor exceeded the limit: the force sent is not the force requested
};

[[nodiscard]] EncodedFrame encode(const MotorFrame& frame) noexcept;

/// Bits of StateFrame::buttons, from far right to far left as the user sees them.
enum Button : std::uint8_t {
  kButtonPlus = 1,
  kButtonForward = 2,
  kButtonCentre = 4,
  kButtonMinus = 8,
};

/// Frame from the device.
struct StateFrame {
  LegCounts encoders{};         ///< relative until homed: the origin jumps at homing
  std::uint8_t buttons = 0;     ///< bits of Button
  std::array<bool, 3> homed{};  ///< each leg has passed its index

  [[nodiscard]] bool all_homed() const noexcept { return homed[0] && homed[1] && homed[2]; }
  friend bool operator==(const StateFrame&, const StateFrame&) = default;
};

/// Finds the frames in a byte stream that may lose, repeat or damage bytes (FTDI status bytes
/// already removed). '<' and '>' never occur inside a frame, so each '<' starts a new one: a fault
/// costs only the frames it touches. The format has no checksum: a letter changed to another, or
/// two halves joined by the loss of a multiple of 16 bytes, cannot be detected.
class FrameReader {
 public:
  /// The next whole frame in `bytes`; advances `bytes` past it. Empty when all bytes are consumed.
  /// A frame may begin in one call and end in another.
  [[nodiscard]] std::optional<StateFrame> next(std::span<const std::uint8_t>& bytes) noexcept;

  /// Number of bytes so far that belonged to no whole frame.
  [[nodiscard]] std::uint64_t discarded() const noexcept { return discarded_; }

 private:
  void take(std::uint8_t byte) noexcept;

  std::array<std::uint8_t, kFrameBytes> frame_{};
  std::size_t size_ = 0;
  std::uint64_t discarded_ = 0;
};

// ---- kinematics ----------------------------------------------------------------------
// Position of the grip and torques of the motors: a translational delta robot of three equal legs,
// after R. E. Stamper, "A three degree of freedom parallel manipulator with only translational
// degrees of freedom", thesis, University of Maryland, 1997.
//
// The device's frame has x to the right, y up and z out of the device towards the user. Each leg
// has its own frame at its hip: u along the leg's direction phi, v perpendicular to it, w = z. With
// the letters of Geometry and t1, t2, t3 the angles of thigh, shin and parallelogram:
//
//   u =  x cos phi + y sin phi - r + c  =  a cos t1 + L cos t2
//   w =  z                              =  a sin t1 + L sin t2,    L = d + e + b sin t3
//   v = -x sin phi + y cos phi - s + f  =  b cos t3
//
// The Falcon is built with its knees outward: 0 < t2 - t1 < pi. Encoders measure t1.

enum class KinematicsError {
  top_leg_unreachable,  ///< the leg would have to extend beyond straight or fold completely
  right_leg_unreachable,
  left_leg_unreachable,
  singular,        ///< the legs cannot push in the requested direction
  not_converged,   ///< no pose found for these angles
  beyond_encoder,  ///< an angle out of range of int16 counts
};

template <class T>
using Solved = tl::expected<T, KinematicsError>;

/// Vectors of angles and torques hold one number per leg: top, right, left.
class Kinematics {
 public:
  /// Middle of the workspace, a ball of 48 mm about it.
  static constexpr glm::dvec3 kCentreMm{0.0, 0.0, 130.0};

  explicit Kinematics(const Geometry& geometry) noexcept;

  /// Thigh angle t1 [rad] of a leg (0 top, 1 right, 2 left), in closed form; empty if it is out of
  /// reach.
  [[nodiscard]] std::optional<double> thigh_angle(int leg,
                                                  const glm::dvec3& position_mm) const noexcept;

  /// All three. The error names the first leg that cannot reach.
  [[nodiscard]] Solved<glm::dvec3> inverse(const glm::dvec3& position_mm) const noexcept;

  /// Position [mm] of the grip at these thigh angles [rad], to rounding. Newton's method from
  /// `start_mm`, at most 16 steps: start at the last position when following the hand, at the
  /// centre when nothing is known. Outside the workspace some angles allow two poses, and the start
  /// selects one. Also `not_converged` if the pose found has a knee turned inward.
  [[nodiscard]] Solved<glm::dvec3> forward(const glm::dvec3& angles_rad,
                                           const glm::dvec3& start_mm = kCentreMm) const noexcept;

  /// J [rad/mm] with d angles = J d position, in closed form. Column-major as in GLM: J[axis][leg].
  [[nodiscard]] Solved<glm::dmat3> jacobian(const glm::dvec3& position_mm) const noexcept;

  /// Torques [N mm] about the hips that push the hand with `force_n` [N]: the solution of
  /// J^T torques = force (virtual work).
  [[nodiscard]] Solved<glm::dvec3> torques(const glm::dvec3& position_mm,
                                           const glm::dvec3& force_n) const noexcept;

  /// Thigh angles [rad] of encoder counts.
  [[nodiscard]] glm::dvec3 angles_of(const LegCounts& counts) const noexcept;
  /// Encoder counts nearest to thigh angles [rad].
  [[nodiscard]] Solved<LegCounts> counts_of(const glm::dvec3& angles_rad) const noexcept;

 private:
  Geometry geometry_;
  glm::dmat3x2 directions_;  // unit vectors of the legs, seen along z
};

struct MotorCounts {
  LegCounts counts{};     ///< within +-kMotorLimit
  double rendered = 1.0;  ///< the fraction of the torque that the motors can give, 0 to 1
};

/// A positive count drives a thigh to smaller angles. If a motor would exceed its limit, all three
/// are scaled alike, which keeps the direction of the force; torques that are not finite give 0.
[[nodiscard]] MotorCounts motor_counts(const glm::dvec3& torques_nmm,
                                       double counts_per_nmm = kMotorCountsPerNmm) noexcept;

// ---- falcon model --------------------------------------------------------------------
// A byte-exact simulation of a Falcon: boot loader, homing, frames, a moving grip, and faults on
// demand. It serves LoopbackTransport and the emulated USB device of the tests. It was written from
// the same notes as the driver, so its fidelity is limited to docs/devices.md.

/// Moves the modelled grip. Called once per frame with the commanded force [N] and the time [s]
/// since the last frame; returns the position [mm] in the frame of Kinematics.
using Grip = std::function<glm::dvec3(const glm::dvec3& force_n, double dt_s)>;
/// Presses its buttons: called once per frame, after Grip; returns their bits.
using Thumb = std::function<std::uint8_t()>;

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
  [[nodiscard]] std::array<std::uint8_t, kFrameBytes> state_frame() const;
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
  std::array<std::uint8_t, kFrameBytes> heard_{};  // of a greeting or a frame
  std::size_t heard_size_ = 0;
  std::vector<std::uint8_t> firmware_;
  std::array<std::uint8_t, kFrameBytes> last_frame_{};
  std::uint64_t frames_ = 0;
  int homing_ = 0;
  int homed_legs_ = 0;
  LegCounts motors_{}, counts_{};
  glm::dvec3 force_n_{0.0}, position_mm_{Kinematics::kCentreMm};
};

// ---- falcon device -------------------------------------------------------------------
// A Novint Falcon on any transport: start-up, homing, frames, kinematics.
//
//   closed --open--> needs_firmware --load--> needs_homing --the user--> ready
//                         ^                        ^                       |
//                     no answer                    +----- homing lost -----+
//   any of them --unplugged, or silent for long--> fault --open--> ...

struct FalconSettings {
  Geometry geometry = kLibnifalconGeometry;
  double motor_counts_per_nmm = kMotorCountsPerNmm;  ///< 0.001 to 1000; more gives a larger force
  glm::dvec3 centre_mm =
      Kinematics::kCentreMm;          ///< the origin of samples, in the frame of Kinematics
  double force_limit_n = 8.0;         ///< 0 to 8.9, the limit that Novint states
  std::int64_t silence_us = 500'000;  ///< without a frame for this time: fault; 10 ms to 60 s
  std::string firmware_path;          ///< empty: the firmware must be loaded already
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

  /// The last motor command; for logs.
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
  glm::dvec3 position_mm_;                // in the frame of the kinematics
  std::int64_t unanswered_since_us_ = 0;  // the first write after the last frame; 0: none
  LegCounts motors_{};
  DeviceCounters counters_;
  std::atomic<bool> stopped_{false};
};

}  // namespace clay::falcon::inline device
