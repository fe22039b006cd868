#pragma once
#include "claystack/engine/pot.hpp"

#include <string>

namespace clay::solid {

/// A drawing of the pot cut through its axis, to scale, with height, diameter and a
/// scale bar [mm]; a collapsed pot is drawn as it lies, seen with the HIP to the right, and where
/// it passed as it fell is dashed.
std::string section_svg(const Pot& pot);

}  // namespace clay::solid
