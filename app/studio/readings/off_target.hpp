#pragma once
// The distance of a pot from its target profile.

#include "app/render/picture.hpp"

#include <optional>
#include <vector>

namespace clay::studio {

/// Distance of a pot from its target.
struct OffTarget {
  double mm = 0.0;                          ///< largest distance between the outlines
  double radius_mm = 0.0, height_mm = 0.0;  ///< place of that distance
  /// For each row of the pot, the larger distance of its two walls from the target's outline.
  std::vector<float> rows_mm;
};

/// Empty for pots without clay.
[[nodiscard]] std::optional<OffTarget> off_target(const render::PotView& pot,
                                                  const render::PotView& target);

/// Distances up to which the window calls a pot equal to its target, and near to it [mm].
inline constexpr double kMatchesMm = 1.0, kNearMm = 3.0;

}  // namespace clay::studio
