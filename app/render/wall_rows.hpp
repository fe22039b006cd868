#pragma once
// The thickness of walls for the map on the pot, from the exact measure of the export.

#include "app/render/picture.hpp"
#include "claystack/core/result.hpp"
#include "claystack/engine/clay.hpp"
#include "claystack/export/section.hpp"
#include "claystack/export/walls.hpp"

#include <cstddef>
#include <span>
#include <vector>

namespace clay::render {

/// The section that walls are measured on: the smoothed profile of `claystack export`, of a fallen
/// pot both parts as they stood. `min_wall_mm`: as SmoothingOptions has it. Errors as
/// solid::smooth_profile_of and solid::collapsed_parts.
Result<solid::Profile> wall_profile(const Pot& pot, std::optional<double> min_wall_mm = {});

/// For each of `rows` equal parts of `height_mm` the least thickness that solid::wall_field finds
/// on the outside and on the bore there.
[[nodiscard]] std::vector<RowWall> row_walls(const solid::Profile& profile, std::size_t rows,
                                             double height_mm);
/// The same of a field that has been measured.
[[nodiscard]] std::vector<RowWall> row_walls(std::span<const solid::WallSample> field,
                                             std::size_t rows, double height_mm);

}  // namespace clay::render
