#pragma once
// Fills pockets of air that are too small to matter, which a union encloses where two rough walls
// meet.

#include "claystack/export/solid.hpp"

#include <cstddef>
#include <vector>

namespace clay::solid::inline fallen {

/// For each shell (points joined by triangles) its volume [mm^3], negative if it faces inward.
[[nodiscard]] std::vector<double> shell_volumes(const TriangleMesh& mesh);

struct FilledPockets {
  TriangleMesh mesh;          ///< without unused points
  std::vector<bool> on_seam;  ///< for each of its points
  std::size_t pockets = 0;
  double volume_mm3 = 0.0;   ///< total volume of the filled pockets
  double max_ball_mm = 0.0;  ///< upper bound of the distance of filled air from the clay around it
};

/// Removes shells that face inward, touch the seam (`on_seam`, for each point of `mesh`) and are at
/// most `deepest_mm` deep. The depth is three times volume over area: no convex pocket contains a
/// ball of a larger radius, but another one may. `max_ball_mm` is a bound for every pocket.
FilledPockets fill_pockets(const TriangleMesh& mesh, const std::vector<bool>& on_seam,
                           double deepest_mm);

}  // namespace clay::solid::inline fallen
