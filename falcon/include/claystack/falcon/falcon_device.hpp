#pragma once
#include "claystack/falcon/device.hpp"

#include <cstdint>
#include <glm/vec3.hpp>
#include <memory>
#include <numbers>
#include <string>

namespace clay::falcon::inline device {

// ---- geometry ------------------------------------------------------------------------
// Dimensions of the Novint Falcon. No accurate measurement is published: the two
// published sets differ by up to 10 mm in the grip's z, so absolute position is uncertain by that
// much. Motion relative to a start is not.

/// One leg (all three are equal); letters as in R. E. Stamper, "A three degree of freedom
/// parallel manipulator with only translational degrees of freedom", 1997.
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

/// Motor counts for 1 N mm at the thigh: Martin and Hillier measured 0.019835 N mm per count at the
/// motor, which agrees with the force Novint states. libnifalcon's 10 renders 1.5 times as much.
inline constexpr double kMotorCountsPerNmm = 1.0 / (0.019835 * 7.62);

/// Middle of the workspace, a ball of 48 mm about it. From the middle of the base, with x to the
/// right, y up and z out of the device towards the user.
inline constexpr glm::dvec3 kFalconCentreMm{0.0, 0.0, 130.0};

// ---- falcon --------------------------------------------------------------------------
// A Novint Falcon on any transport.

/// Bits of DeviceSample::buttons of a Falcon, from far right to far left as the user sees them.
enum Button : std::uint8_t {
  kButtonPlus = 1,
  kButtonForward = 2,
  kButtonCentre = 4,
  kButtonMinus = 8,
};

struct FalconSettings {
  Geometry geometry = kLibnifalconGeometry;
  double motor_counts_per_nmm = kMotorCountsPerNmm;  ///< 0.001 to 1000; more gives a larger force
  glm::dvec3 centre_mm = kFalconCentreMm;            ///< the origin of samples, as kFalconCentreMm
  double force_limit_n = 8.0;                        ///< 0 to 8.9, the limit that Novint states
  std::int64_t silence_us = 500'000;  ///< without a frame for this time: fault; 10 ms to 60 s
  std::string firmware_path;          ///< empty: the firmware must be loaded already
};

/// A Falcon, or its model, at the other end of `line`. `open` starts it and refuses settings
/// out of their ranges (`bad_setting`).
[[nodiscard]] std::unique_ptr<HapticDevice> make_falcon(std::unique_ptr<Transport> line,
                                                        const FalconSettings& settings);

}  // namespace clay::falcon::inline device
