#pragma once
// Devices, positions and vectors for properties of the kinematics.

#include "falcon/device/kinematics.hpp"
#include "tests/falcon/random_values.hpp"

#include <algorithm>
#include <glm/geometric.hpp>
#include <numbers>

namespace clay::falcon {

inline constexpr double kWorkspaceRadiusMm = 48.0;
inline constexpr double kPi = std::numbers::pi;
inline constexpr glm::dvec3 kAxes[] = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}};

inline const Kinematics& any_device() {
  static const Kinematics devices[] = {Kinematics(kLibnifalconGeometry),
                                       Kinematics(kMartinHillierGeometry)};
  return devices[*rc::gen::inRange(0, 2)];
}

inline glm::dvec3 any_vector(double size) {
  return {within(-size, size), within(-size, size), within(-size, size)};
}

inline glm::dvec3 anywhere_within(double radius) {
  const glm::dvec3 v = any_vector(radius);
  return kFalconCentreMm + v * std::min(1.0, radius / (glm::length(v) + 1e-9));
}

inline glm::dvec3 anywhere() { return anywhere_within(kWorkspaceRadiusMm); }

template <class T>
[[nodiscard]] bool fails_with(const Solved<T>& solved, KinematicsError error) {
  return !solved && solved.error() == error;
}

}  // namespace clay::falcon
