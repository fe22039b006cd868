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

enum class Openings {
  refused,
  all_refused,  ///< also those without a rim: parts of the mesh are missing
  capped,
  kept,   ///< stay open, as all borders that are not filled
  closed  ///< as the faces of solids that bound each other
};

/// Fills holes of up to kMaxHoleEdges edges by triangles between their vertices. If two borders lie
/// in one plane, and one encloses the other, the ring between them is filled. A wide opening is an
/// error (`unsound`) if `refused`: its cap would cover at least 1/50 of the surface, and most of
/// its border is a rim, where cap and surface meet at more than 60 degrees. If `all_refused`, the
/// rim does not matter. A wide border of a
/// surface with one side is an error also if `capped` or `kept`. After an error the surface
/// contains the patches.
Result<FilledHoles> fill_holes(Surface& surface, Openings openings);

/// The error for a hole that was not filled.
tl::unexpected<Error> unfilled(const FilledHole& hole);

}  // namespace clay::solid::inline repair
