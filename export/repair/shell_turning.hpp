#pragma once
#include "export/repair/half_edge_surface.hpp"

#include <cstddef>

namespace clay::solid::inline repair {

/// Reverses all shells of a closed surface if their volume is negative, then those of negative
/// volume of which at most a quarter of the surface, as sampled, lies in positive shells, and those
/// that lie in a cavity. A positive shell inside another one stays as it is.
/// Returns the number of reversed shells; 0 for a surface that is not closed.
std::size_t turn_shells(Surface& surface);

}  // namespace clay::solid::inline repair
