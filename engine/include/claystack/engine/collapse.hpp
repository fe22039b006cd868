#pragma once
// The fall of a pot that failed: the way of the upper part, and where it comes to rest.

#include "claystack/engine/clay.hpp"

#include <glm/vec3.hpp>
#include <vector>

namespace clay {

/// Where a collapse takes the clay above the failed ring: a turn about the pivot, then a shift.
/// Half turns are exact.
class FallenPlace {
 public:
  explicit FallenPlace(const Collapse& collapse) noexcept;
  /// Where a point [mm, y up] of the standing pot came to lie.
  [[nodiscard]] glm::dvec3 operator()(const glm::dvec3& point_mm) const noexcept;

 private:
  glm::dvec3 pivot_mm_, axis_, shift_mm_;
  double cosine_ = 1.0, sine_ = 0.0;
};

/// A moment of a fall; the first is the pot as it failed, the last is at rest.
struct FallFrame {
  double angle_rad = 0.0;     ///< as Collapse::angle_rad
  glm::dvec3 shift_mm{0.0};   ///< as Collapse::shift_mm
  double potential_mj = 0.0;  ///< of the upper part, above the wheel head: never rises
  double plastic_mj = 0.0;    ///< work done on the lower clay so far
  friend bool operator==(const FallFrame&, const FallFrame&) = default;
};

/// The fall that led to `pot.collapse`, worked out again, so that it can be shown; some hundreds of
/// frames, none farther from the last than 1/400 of the fallen part's size. Empty for a pot that
/// stands and for a collapse that does not say its threshold.
[[nodiscard]] std::vector<FallFrame> fall_frames(const Pot& pot);

}  // namespace clay
