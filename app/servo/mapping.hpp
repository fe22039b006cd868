#pragma once
// From the device's workspace to the wheel, and forces back.
//
//   p_clay = offset + scale D p_device,     F_device = force_gain D F_clay
//
// D turns axes over, so it is its own transpose. With force_gain = scale the hand does just the
// work that the tool does; with any other it does force_gain / scale of it, at every motion, so a
// contact that gives no energy to the tool gives none to the hand. The hand feels the contact's
// stiffness times force_gain scale: by default, force_gain = 1 / scale, the stiffness that the
// scene states.

#include "claystack/core/result.hpp"

#include <glm/vec3.hpp>
#include <string>

namespace clay::servo {

/// Where the hand works; the middle of the workspace lies there, at half the height.
enum class Side { right, left, front };

struct MappingSettings {
  /// Wheel mm to a mm of the hand, 0.1 to 10. 1.6 makes 154 mm of a Falcon's 96.
  double scale = 1.6;
  double force_gain = 0.0;  ///< N at the hand to a N at the tool, to 10; 0: 1 / scale
  Side side = Side::right;
  double reach_mm = 60.0;   ///< of the workspace's middle from the axis, 0 to 1000
  double height_mm = 75.0;  ///< and above the wheel head, -1000 to 1000
  bool flip_x = false, flip_y = false, flip_z = false;
  friend bool operator==(const MappingSettings&, const MappingSettings&) = default;
};

class Mapping {
 public:
  /// Errors name the option of the command line.
  static Result<Mapping> build(const MappingSettings& settings);

  [[nodiscard]] glm::dvec3 to_clay(const glm::dvec3& device_mm) const noexcept;
  /// Its inverse.
  [[nodiscard]] glm::dvec3 to_device(const glm::dvec3& clay_mm) const noexcept;
  [[nodiscard]] glm::dvec3 force_to_device(const glm::dvec3& clay_n) const noexcept;

  /// The clutch is let go with the hand here: from now on this is where the tool is.
  void recentre(const glm::dvec3& device_mm, const glm::dvec3& clay_mm) noexcept;

  /// Stiffness at the hand divided by stiffness at the tool.
  [[nodiscard]] double stiffness_gain() const noexcept { return force_gain_ * scale_; }

 private:
  double scale_ = 1.0, force_gain_ = 1.0;
  glm::dvec3 turned_{1.0};  // the diagonal of D
  glm::dvec3 offset_mm_{0.0};
};

}  // namespace clay::servo
