#pragma once
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

#include "claystack/falcon/falcon_device.hpp"
#include "falcon/device/frame.hpp"

#include <glm/mat3x2.hpp>
#include <glm/mat3x3.hpp>
#include <glm/vec3.hpp>
#include <numbers>
#include <optional>
#include <tl/expected.hpp>

namespace clay::falcon::inline device {

/// Directions of the top, right and left leg about the z axis, from x [rad]: 105, -15, -135 deg.
inline constexpr double kLegDirectionsRad[] = {std::numbers::pi * 7 / 12, -std::numbers::pi / 12,
                                               -std::numbers::pi * 3 / 4};

/// 320 slots of the encoder wheel, each counted four times in quadrature.
inline constexpr double kCountsPerMotorTurn = 320 * 4;

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
  explicit Kinematics(const Geometry& geometry) noexcept;

  /// Thigh angle t1 [rad] of a leg (0 top, 1 right, 2 left), in closed form; empty if it is out of
  /// reach.
  [[nodiscard]] std::optional<double> thigh_angle(int leg,
                                                  const glm::dvec3& position_mm) const noexcept;

  /// All three. The error names the first leg that cannot reach.
  [[nodiscard]] Solved<glm::dvec3> inverse(const glm::dvec3& position_mm) const noexcept;

  /// Position [mm] of the grip at these thigh angles [rad], to rounding. Newton's method from
  /// `start_mm`, at most 16 steps: start at the last position to follow the hand, and at the centre
  /// if the position is not known. Outside the workspace some angles allow two poses, and the start
  /// selects one. Also `not_converged` if the pose found has a knee turned inward.
  [[nodiscard]] Solved<glm::dvec3> forward(
      const glm::dvec3& angles_rad, const glm::dvec3& start_mm = kFalconCentreMm) const noexcept;

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

/// Within +-kMotorLimit. A positive count drives a thigh to smaller angles. If a motor would exceed
/// its limit, all three are scaled alike, which keeps the direction of the force; torques that are
/// not finite give 0.
[[nodiscard]] LegCounts motor_counts(const glm::dvec3& torques_nmm,
                                     double counts_per_nmm = kMotorCountsPerNmm) noexcept;

}  // namespace clay::falcon::inline device
