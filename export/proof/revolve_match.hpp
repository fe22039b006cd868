#pragma once
// Checks whether a decoded mesh is a given revolve, for any order of its points and triangles.

#include "claystack/core/result.hpp"
#include "claystack/export/formats.hpp"
#include "claystack/export/solid.hpp"
#include "export/solid/revolve_layout.hpp"

#include <string_view>

namespace clay::solid::inline proof {

/// Finds for every point the vertex of the revolve within `reach_mm`, and for every triangle its
/// place in the layout; each place must occur exactly once. Requires vertices more than two reaches
/// apart (see `Margins`), or points that are exactly the vertices as a file of this format holds
/// them (see `held_point`), without duplicates.
/// Returns the largest distance [mm] of a point from its vertex. Errors (kind `unsound`) begin with
/// `name` and name the point or triangle without a place.
Result<double> match_revolve(const TriangleMesh& decoded, const RevolveLayout& rule,
                             double reach_mm, MeshFormat format, std::string_view name);

}  // namespace clay::solid::inline proof
