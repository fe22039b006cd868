#pragma once
// Formats with numbered points, whose writers may repeat a point for each triangle.

#include "claystack/export/solid.hpp"

#include <string>
#include <vector>

namespace clay::solid::inline formats {

/// Merges points with equal coordinates, as readers of formats without numbers do, if that joins
/// triangles at edges that are open otherwise. Then `notes`, which may be null, gets a line. All
/// coordinates are float32, and indices are in range.
void share_equal_points(TriangleMesh& mesh, std::vector<std::string>* notes);

}  // namespace clay::solid::inline formats
