#pragma once
// Horizontal lines that a program or a hand has turned or rounded.

#include "app/import/drawing.hpp"

#include <vector>

namespace clay::importing {

/// Gives one height to all points of nearly one height, and puts points near the axis on it. A
/// horizontal line that is not quite level would need very fine rings; a line beside the axis
/// would become a bore. The axis is at x = 0.
void straighten(std::vector<Line>& lines);

/// Levels pieces that rise by at most `within_mm` over at least five times that length, also where
/// several follow each other. The lowest and the highest point keep their heights.
void level(std::vector<Line>& lines, double within_mm);

}  // namespace clay::importing
