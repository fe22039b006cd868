#pragma once
#include "export/repair/half_edge_surface.hpp"

namespace clay::solid::inline repair {

/// A border that passes the same place twice bounds two holes that touch there. Its vertices in
/// that place become one, so that each hole has a separate border, if each border then has at least
/// three edges. Returns the number of vertices that were removed.
std::size_t join_borders(Surface& surface);

}  // namespace clay::solid::inline repair
