#pragma once
// Ranges of the settings of an import: for the command line and for Python [mm].

#include "core/range.hpp"

namespace clay::importing {

/// Of the pot to which a drawing or a mesh is scaled.
inline constexpr Range kPotHeightRange = from(0.01).to(1e5);
/// Of the wall of a drawing that shows only the outside.
inline constexpr Range kDrawnWallRange = from(0.01).to(1e3);

}  // namespace clay::importing
