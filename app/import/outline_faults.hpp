#pragma once
// Faults of the outlines of a drawing, for messages that name the cause.

#include "app/import/drawing.hpp"

#include <optional>
#include <span>
#include <string>
#include <vector>

namespace clay::importing {

/// Every corner and the middle of every piece have a mirror image on the outlines, within a
/// distance.
[[nodiscard]] bool mirrored_within(const std::vector<Line>& lines, double middle_mm,
                                   double within_mm);

/// A drawing of both halves by hand: the same, within a fiftieth of the width of the outlines.
[[nodiscard]] bool nearly_mirrored(const std::vector<Line>& lines, double middle_mm);

/// Whether a straight piece of an outline lies along the vertical line at `x_mm`.
[[nodiscard]] bool edge_along(const std::vector<Line>& lines, double x_mm);

/// Two ends of open lines.
struct Gap {
  glm::dvec2 from{0.0}, to{0.0};
  double mm = 0.0;
};

/// The nearest ends of lines that are open, in a drawing whose axis is at x = 0; ends on the axis
/// do not count. Empty if there are fewer than two.
[[nodiscard]] std::optional<Gap> narrowest_gap(const std::vector<Line>& lines);

/// The clay at one height: "from the axis to 12 mm and from 27 to 30 mm". `radii_mm`: the radii at
/// which it begins and ends, descending. After four places "and more".
[[nodiscard]] std::string clay_between(std::span<const double> radii_mm);

}  // namespace clay::importing
