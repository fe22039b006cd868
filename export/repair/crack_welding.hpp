#pragma once
#include "export/repair/soup_edges.hpp"

#include <cstddef>
#include <optional>
#include <vector>

namespace clay::solid::inline repair {

struct OpenBorder {
  std::vector<SoupEdge> edges;  ///< those of one triangle only
  std::vector<bool> points;     ///< whether a point is on one
  double rounding_mm = 0.0;     ///< rounding to float32 alone may open a crack this wide
  double crack_mm = 0.0;        ///< points at this distance count as one; 0: there is no crack
};

/// For `weld_mm` see RepairOptions. Requires finite points.
OpenBorder open_border(const TriangleMesh& mesh, std::optional<double> weld_mm);

/// Points of open edges within `weld_mm` of each other become one; for the default see
/// RepairOptions. Requires finite points. Returns the number of points that were welded.
std::size_t weld_cracks(TriangleMesh& mesh, std::optional<double> weld_mm);

}  // namespace clay::solid::inline repair
