#pragma once
#include "export/repair/half_edge_surface.hpp"

#include <cstddef>

namespace clay::solid::inline repair {

/// Reverses shells of a closed surface so that it bounds a volume. If shells intersect, all are
/// reversed if their volume is negative, then those of negative volume that lie in no other one.
/// Returns the number of reversed shells; 0 for a surface that is not closed.
std::size_t turn_shells(Surface& surface);

}  // namespace clay::solid::inline repair
