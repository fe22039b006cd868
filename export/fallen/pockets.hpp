#pragma once
// Where two rough walls meet, their union traps air in pockets too small to mean anything.

#include "claystack/export/solid.hpp"

#include <cstddef>
#include <vector>

namespace clay::solid::inline fallen {

/// For each shell (points joined by triangles) its volume [mm^3], negative where it faces inward.
[[nodiscard]] std::vector<double> shell_volumes(const TriangleMesh& mesh);

struct FilledPockets {
  TriangleMesh mesh;          ///< without points that no triangle uses
  std::vector<bool> on_seam;  ///< for each of its points
  std::size_t pockets = 0;
  double volume_mm3 = 0.0;    ///< what they held
  double max_depth_mm = 0.0;  ///< no pocket was deeper
};

/// Leaves out shells that face inward, touch the seam (`on_seam`, for each point of `mesh`) and
/// are no deeper than `deepest_mm`. The depth is three times volume over area: no convex pocket
/// holds a ball of a larger radius.
FilledPockets fill_pockets(const TriangleMesh& mesh, const std::vector<bool>& on_seam,
                           double deepest_mm);

}  // namespace clay::solid::inline fallen
