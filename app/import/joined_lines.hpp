#pragma once
#include "app/import/drawing.hpp"

#include <cstdint>
#include <utility>

namespace clay::importing {

/// Ends closer than this are one point: smaller gaps are drawing errors.
inline constexpr double kSamePointMm = 0.01;

/// A square of side kSamePointMm: its column and its row.
using Cell = std::pair<std::int64_t, std::int64_t>;
[[nodiscard]] Cell cell_of(glm::dvec2 p);

/// Removes lines that equal an earlier one, drawn in either direction, or from another corner if
/// they are closed. Returns their number.
std::size_t remove_repeats(std::vector<Line>& lines);

/// Joins open lines end to end, in either direction; closes those whose ends meet. Leaves out lines
/// that are only a point, such as a circle of radius 0.
[[nodiscard]] std::vector<Line> joined(std::vector<Line> lines);

}  // namespace clay::importing
