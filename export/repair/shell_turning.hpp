#pragma once
#include "export/repair/half_edge_surface.hpp"

#include <cstddef>

namespace clay::solid::inline repair {

/// Reverses all shells of a closed surface if their volume is negative, then those of negative
/// volume that lie in no clay. A positive shell inside another one stays as it is.
/// Returns the number of reversed shells; 0 for a surface that is not closed.
std::size_t turn_shells(Surface& surface);

}  // namespace clay::solid::inline repair
