#pragma once
#include "app/import/drawing.hpp"

namespace clay::importing {

/// Ends nearer than this are one point: nobody draws a gap of a hundredth of a millimetre.
inline constexpr double kSamePointMm = 0.01;

/// Open lines joined where they meet, end to end, either way round; closed where the ends do.
[[nodiscard]] std::vector<Line> joined(std::vector<Line> lines);

}  // namespace clay::importing
