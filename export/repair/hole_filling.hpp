#pragma once
#include "claystack/core/result.hpp"
#include "claystack/export/repair.hpp"
#include "export/repair/half_edge_surface.hpp"

#include <optional>
#include <vector>

namespace clay::solid::inline repair {

struct FilledHoles {
  std::vector<FilledHole> filled;
  std::optional<FilledHole> left;  ///< the first one that was not filled
};

/// Fills holes of up to kMaxHoleEdges edges by triangles between their vertices. A wide opening is
/// an error (`unsound`) unless `cap_openings`: its cap would cover at least 1/50 of the surface,
/// and most of its border is a rim, where cap and surface meet at more than 60 degrees. After an
/// error the surface contains the patches.
Result<FilledHoles> fill_holes(Surface& surface, bool cap_openings);

/// The error for a hole that was not filled.
tl::unexpected<Error> unfilled(const FilledHole& hole);

}  // namespace clay::solid::inline repair
