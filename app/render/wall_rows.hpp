#pragma once
// Wall thickness for the map on the pot, measured exactly as in the export.

#include "app/render/picture.hpp"
#include "claystack/core/result.hpp"
#include "claystack/engine/clay.hpp"
#include "claystack/export/section.hpp"
#include "claystack/export/walls.hpp"

#include <cstddef>
#include <span>
#include <vector>

namespace clay::render {

/// The section on which walls are measured: the smoothed profile of `claystack export`; for a
/// collapsed pot both parts before the collapse. `min_wall_mm`: as in SmoothingOptions. Errors as
/// for solid::smooth_profile_of and solid::collapsed_parts.
Result<solid::Profile> wall_profile(const Pot& pot, std::optional<double> min_wall_mm = {});

/// For each of `rows` equal parts of `height_mm`, the minimum thickness of solid::wall_field on the
/// outside and on the bore.
[[nodiscard]] std::vector<RowWall> row_walls(const solid::Profile& profile, std::size_t rows,
                                             double height_mm);
/// The same for an existing field.
[[nodiscard]] std::vector<RowWall> row_walls(std::span<const solid::WallSample> field,
                                             std::size_t rows, double height_mm);

}  // namespace clay::render
