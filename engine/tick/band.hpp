#pragma once
// The part of the wall that a tool presses, finer than rings: the input of the clay rules.

#include "claystack/engine/clay.hpp"
#include "claystack/engine/tool.hpp"
#include "engine/tick/contact.hpp"

#include <cstddef>

namespace clay {

/// A band of the wall under one tool, or under the two of a pinch. [mm]
struct Band {
  double low_mm = 0.0, high_mm = 0.0;  ///< ends of the contact above the wheel head
  double peak_mm = 0.0;                ///< height at which the surface gives way most (`Peak`)
  double give_mm = 0.0;                ///< distance by which it gives way, the mean over 4 mm
  double deepest_mm = 0.0;             ///< of the tool in the clay
  std::size_t ring = 0;                ///< of the peak

  [[nodiscard]] double height_mm() const noexcept { return high_mm - low_mm; }
};

/// Mean height of the touched rings, weighted by the eighth power of the distance by which each
/// gives way. For a rib it is the middle of the contact; a small change of one ring hardly moves
/// it.
struct Peak {
  double weight = 0.0, sum = 0.0;  ///< levels in ring heights

  void add(double level, double give_mm) noexcept {
    const double square = give_mm * give_mm, fourth = square * square;
    weight += fourth * fourth;
    sum += fourth * fourth * level;
  }
  /// Writes the peak and its ring. `band` has its ends.
  void settle(double ring_height_mm, Band& band) const noexcept;
};

/// The depth of the tool in a ring; below 0: minus its distance from the ring. For a ring whose
/// middle is beyond an end of the tool: -1e300.
[[nodiscard]] double signed_depth(const Tool& tool, const ClayStack& stack, double hip_y,
                                  std::size_t ring, const Contact& contact) noexcept;

/// The band of a contact whose rings have given way (`TouchedRings::give`). Ends lie where the
/// depth is 0 between two rings, or at the tool's own end.
[[nodiscard]] Band band_of(const Tool& tool, const ClayStack& stack, double hip_y,
                           const Contact& contact) noexcept;

}  // namespace clay
