#pragma once
// Transforms of an SVG drawing, as an attribute or as a property of a style sheet, and numbers with
// units as they occur there.

#include "claystack/core/result.hpp"

#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace clay::importing {

/// A transform in the syntax of CSS (CSS Transforms 1: "translate(5mm, 0) rotate(0.1turn)") or of
/// the attribute, as functions of the attribute, with lengths in px and angles in degrees.
/// `origin`: the property transform-origin, as two lengths. Refused by the name of the property:
/// functions of space, lengths in percent or of the font, an origin in words.
Result<std::string> svg_transform(std::string_view transform,
                                  const std::optional<std::string>& origin);

/// The numbers of a list separated by commas or blanks; none if there is anything else.
[[nodiscard]] std::vector<double> svg_numbers(std::string_view list);

/// A number, perhaps with a unit, times `factor`; unchanged if it does not begin with a number.
[[nodiscard]] std::string svg_scaled(std::string_view length, double factor);

}  // namespace clay::importing
