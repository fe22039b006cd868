#pragma once
// Sizes of the Novint Falcon in SI units. Nobody measured one well: the two published sets put
// the grip up to 10 mm apart along z, so absolute position is uncertain by that much. Motion
// relative to a start is not.

#include <numbers>

namespace clay::falcon {

/// Directions of the top, right and left leg about the z axis, from x [rad]: 105, -15, -135 deg.
inline constexpr double kLegDirectionsRad[] = {std::numbers::pi * 7 / 12, -std::numbers::pi / 12,
                                               -std::numbers::pi * 3 / 4};

/// One leg, the same three times; letters as in Stamper's thesis (see kinematics.hpp).
struct Geometry {
  double thigh_m;         ///< a: hip to knee
  double shin_m;          ///< b: side of the shin's parallelogram
  double shin_ends_m;     ///< d + e: from knee and grip to the parallelogram's corners
  double base_radial_m;   ///< r: centre to hip, along the leg
  double base_lateral_m;  ///< s: the same, across
  double grip_radial_m;   ///< c: grip's centre to its joint, along the leg
  double grip_lateral_m;  ///< f: the same, across
  double gear_ratio;      ///< motor turns in a turn of the thigh
  double zero_angle_rad;  ///< thigh angle at encoder count 0
};

/// libnifalcon, FalconGeometry.h.
inline constexpr Geometry kLibnifalconGeometry = {
    .thigh_m = 0.060,
    .shin_m = 0.1025,
    .shin_ends_m = 2 * 0.01125,
    .base_radial_m = 0.0400,
    .base_lateral_m = -0.02309,
    .grip_radial_m = 0.01443,
    .grip_lateral_m = -0.025,
    .gear_ratio = 0.110 / 0.01425,
    .zero_angle_rad = std::numbers::pi * 35 / 180,
};

/// Martin and Hillier, "Characterisation of the Novint Falcon haptic device for application as
/// a robot manipulator", ACRA 2009. The zero angle is what users of this set report.
inline constexpr Geometry kMartinHillierGeometry = {
    .thigh_m = 0.060,
    .shin_m = 0.1025,
    .shin_ends_m = 2 * 0.0115,
    .base_radial_m = 0.0366,
    .base_lateral_m = 0.0272,
    .grip_radial_m = 0.0157,
    .grip_lateral_m = 0.0262,
    .gear_ratio = 7.62,
    .zero_angle_rad = std::numbers::pi * 40 / 180,
};

/// 320 slots of the encoder wheel, each seen four times in quadrature.
inline constexpr double kCountsPerMotorTurn = 320 * 4;

/// Motor counts for 1 N m at the thigh: Martin and Hillier measured 1.9835e-5 N m a count at the
/// motor, which agrees with the force Novint states. libnifalcon's 10000 renders half as much
/// again.
inline constexpr double kMotorCountsPerNm = 1.0 / (1.9835e-5 * 7.62);

}  // namespace clay::falcon
