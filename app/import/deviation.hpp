#pragma once
// How far two half sections are from each other.

#include "app/import/half_section.hpp"

#include <span>

namespace clay::importing {

/// The largest distance from a point of one outline to the nearest of the other, in either
/// direction, and where. Outlines do not include the axis.
struct Deviation {
  double mm = 0.0;         ///< attained; no distance is larger by more than kDeviationStepMm
  double radius_mm = 0.0;  ///< from the axis
  double height_mm = 0.0;  ///< above the foot
};

inline constexpr double kDeviationStepMm = 1e-3;

[[nodiscard]] Deviation deviation_between(std::span<const Slab> a, std::span<const Slab> b);

}  // namespace clay::importing
