#pragma once
#include "export/solid/half_edge_mesh.hpp"

#include <cstddef>
#include <functional>

namespace clay::solid {

/// Collapses edges of a closed mesh until `max_triangles` remain or no edge may collapse: by
/// Garland and Heckbert's error quadrics, the smallest error first; no collapse flips or folds a
/// face. Removed elements are marked as deleted. `progress` may be empty; it gets the share of the
/// collapses, 0 to 1.
void collapse_edges(HalfEdgeMesh& mesh, std::size_t max_triangles,
                    const std::function<void(double)>& progress);

}  // namespace clay::solid
