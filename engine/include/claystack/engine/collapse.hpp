#pragma once
// The collapse of a failed pot: the path of the upper part, and its resting place.

#include "claystack/engine/clay.hpp"

#include <glm/vec3.hpp>
#include <vector>

namespace clay {

/// The motion of the clay above the failed ring: a rotation about the pivot, then a translation.
/// Half turns are exact.
class FallenPlace {
 public:
  explicit FallenPlace(const Collapse& collapse) noexcept;
  /// The resting place of a point [mm, y up] of the standing pot.
  [[nodiscard]] glm::dvec3 operator()(const glm::dvec3& point_mm) const noexcept;

 private:
  glm::dvec3 pivot_mm_, axis_, shift_mm_;
  double cosine_ = 1.0, sine_ = 0.0;
};

/// One moment of a collapse; the first is the pot as it failed, the last is at rest.
struct FallFrame {
  double angle_rad = 0.0;     ///< as Collapse::angle_rad
  glm::dvec3 shift_mm{0.0};   ///< as Collapse::shift_mm
  double potential_mj = 0.0;  ///< of the upper part, above the wheel head; never rises
  double plastic_mj = 0.0;    ///< work done on the lower clay so far
  friend bool operator==(const FallFrame&, const FallFrame&) = default;
};

/// Recomputes the motion that led to `pot.collapse`, for display: some hundred frames, each at most
/// 1/400 of the fallen part's size from the last. Empty for a standing pot and for a collapse
/// without a threshold.
[[nodiscard]] std::vector<FallFrame> fall_frames(const Pot& pot);

}  // namespace clay
