#pragma once
// The thickness of the clay all along a section, as a table for plots and spreadsheets.

#include "claystack/export/walls.hpp"

#include <string>
#include <string_view>
#include <vector>

namespace clay::cli {

/// No two samples of a table are farther apart along an edge.
inline constexpr double kWallSpacingMm = 0.5;

[[nodiscard]] inline bool is_wall_table(std::string_view path) { return path.ends_with(".csv"); }

/// "outer", "bore", ...
[[nodiscard]] std::string_view name_of(solid::WallFace face);

/// CSV with a header; lengths in mm, thickness empty where nothing is opposite.
[[nodiscard]] std::string wall_table(const std::vector<solid::WallSample>& field);

}  // namespace clay::cli
