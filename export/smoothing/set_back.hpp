#pragma once
#include "claystack/core/result.hpp"
#include "export/smoothing/wall_guard.hpp"

namespace clay::solid::inline smoothing {

/// The clay at least `distance_mm` from every face but the foot: the section eroded by a disc, as
/// an outline, within `tolerance_mm`. Where the rim, or the tip of a solid, is too narrow for that,
/// it ends lower, on a flat of `kLeastRimMm`. Errors (bad_input): a pot that is closed above or
/// hollow below its floor, a floor no thicker than the distance.
Result<Polygon> set_back(const WallLines& lines, double distance_mm, double tolerance_mm);

inline constexpr double kLeastRimMm = 0.1;

}  // namespace clay::solid::inline smoothing
