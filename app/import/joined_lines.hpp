#pragma once
#include "app/import/drawing.hpp"

namespace clay::importing {

/// Ends closer than this are one point: smaller gaps are drawing errors.
inline constexpr double kSamePointMm = 0.01;

/// Joins open lines end to end, in either direction; closes those whose ends meet.
[[nodiscard]] std::vector<Line> joined(std::vector<Line> lines);

}  // namespace clay::importing
