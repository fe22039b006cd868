#pragma once
#include "claystack/export/walls.hpp"

#include <string>
#include <vector>

namespace clay::cli {

/// An SVG of both sides of the section, coloured by the wall; the scale of colours is fitted to
/// this pot.
[[nodiscard]] std::string wall_map_svg(const std::vector<solid::WallSample>& field);

}  // namespace clay::cli
