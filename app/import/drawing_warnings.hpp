#pragma once
// Warnings about a pot made from a drawing, for the command line and for Python.

#include "app/import/drawn_pot.hpp"
#include "app/import/half_section.hpp"

#include <string>
#include <vector>

namespace clay::importing {

/// About a height that suggests another unit, rings that are far from the drawing, a rim with a
/// sharp edge, and rings that do not touch. Each begins with `name`, that of the drawing. The notes
/// of the section are not among them. `settings`: those with which the pot was made.
std::vector<std::string> drawing_warnings(const HalfSection& section, const DrawnPot& drawn,
                                          const DrawnPotSettings& settings,
                                          const std::string& name);

}  // namespace clay::importing
