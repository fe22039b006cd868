#pragma once
// Is a decoded mesh the revolve it claims to be? Whatever the order of its points and triangles.

#include "claystack/core/result.hpp"
#include "claystack/export/solid.hpp"
#include "export/solid/revolve_layout.hpp"

#include <string_view>

namespace clay::solid::inline proof {

/// Finds for every point the vertex of the revolve within `reach_mm` of it, and for every triangle
/// its place in the rule; each place must be taken exactly once. Vertices must stand more than two
/// reaches apart (see `Margins`), or the points be the vertices in float32, no two alike. Returns
/// the largest distance [mm] of a point from its vertex. Errors (kind `unsound`) begin with `name`
/// and say which point or triangle has no place.
Result<double> match_revolve(const TriangleMesh& decoded, const RevolveLayout& rule,
                             double reach_mm, std::string_view name);

}  // namespace clay::solid::inline proof
