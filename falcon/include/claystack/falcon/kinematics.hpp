#pragma once
// Where the grip is and what the motors must do: a translational delta of three equal legs,
// after R. E. Stamper, "A three degree of freedom parallel manipulator with only translational
// degrees of freedom", thesis, University of Maryland, 1997.
//
// The device's frame has x to the right, y up and z out of the device towards the user. A leg
// has a frame of its own from its hip: u along the leg's direction phi, v across, w = z. There,
// with the letters of geometry.hpp and t1, t2, t3 the angles of thigh, shin and parallelogram,
//
//   u =  x cos phi + y sin phi - r + c  =  a cos t1 + L cos t2
//   w =  z                              =  a sin t1 + L sin t2,    L = d + e + b sin t3
//   v = -x sin phi + y cos phi - s + f  =  b cos t3
//
// The Falcon is built with its knees outward: 0 < t2 - t1 < pi. Encoders measure t1.

#include "claystack/falcon/frame.hpp"
#include "claystack/falcon/geometry.hpp"

#include <glm/mat3x2.hpp>
#include <glm/mat3x3.hpp>
#include <glm/vec3.hpp>
#include <optional>
#include <tl/expected.hpp>

namespace clay::falcon {

enum class KinematicsError {
  top_leg_unreachable,  ///< the leg would have to stretch or fold further than straight
  right_leg_unreachable,
  left_leg_unreachable,
  singular,        ///< the legs can't push in the direction asked
  not_converged,   ///< no pose found for these angles
  beyond_encoder,  ///< an angle that no int16 counts
};

template <class T>
using Solved = tl::expected<T, KinematicsError>;

/// Vectors of angles and torques hold one number for each leg: top, right, left.
class Kinematics {
 public:
  /// Middle of the workspace, a ball of 48 mm about it.
  static constexpr glm::dvec3 kCentreM{0.0, 0.0, 0.13};

  explicit Kinematics(const Geometry& geometry) noexcept;

  /// Thigh angle t1 [rad] of one leg, 0 to 2, in closed form; nothing when out of its reach.
  [[nodiscard]] std::optional<double> thigh_angle(int leg,
                                                  const glm::dvec3& position_m) const noexcept;

  /// All three. The error names the first leg that can't reach.
  [[nodiscard]] Solved<glm::dvec3> inverse(const glm::dvec3& position_m) const noexcept;

  /// Position [m] of the grip at these thigh angles [rad], to rounding. Newton's method from
  /// `start_m`, at most 16 steps: start at the last position when following the hand, at the
  /// centre when nothing is known. Outside the workspace some angles allow two poses, and the
  /// start decides. `not_converged` also when the pose found has a knee turned inward.
  [[nodiscard]] Solved<glm::dvec3> forward(const glm::dvec3& angles_rad,
                                           const glm::dvec3& start_m = kCentreM) const noexcept;

  /// J [rad/m] with d angles = J d position, by formula. Column-major as all of GLM: J[axis][leg].
  [[nodiscard]] Solved<glm::dmat3> jacobian(const glm::dvec3& position_m) const noexcept;

  /// Torques [N m] about the hips that push the hand with `force_n` [N]: the solution of
  /// J^T torques = force (virtual work).
  [[nodiscard]] Solved<glm::dvec3> torques(const glm::dvec3& position_m,
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
  double rendered = 1.0;  ///< the part of the torque that the motors can give, 0 to 1
};

/// A positive count drives a thigh to smaller angles. When one motor would pass its limit all three
/// are scaled alike, which keeps the direction of the force; torques that are not finite give 0.
[[nodiscard]] MotorCounts motor_counts(const glm::dvec3& torques_nm,
                                       double counts_per_nm = kMotorCountsPerNm) noexcept;

}  // namespace clay::falcon
