#pragma once
// A wall around a surface by moving its vertices. Requires CGAL's headers.

#include "export/repair/half_edge_surface.hpp"

#include <optional>

namespace clay::solid::inline repair {

/// A wall of the thickness `2 * half_mm`, half on each side of an open surface: each vertex is
/// moved to both sides, at least `half_mm` away from the planes of its triangles, and each border
/// gets a lip between the two. So flat and evenly curved walls have that thickness exactly, also
/// beside sharp edges, with two triangles for each one. At uneven vertices it is more, up to
/// `kMostOffsetShare`. Where a bend is narrower than the wall, the result intersects itself: the
/// caller checks that. Points are rounded to float32; call it with a little more thickness than
/// needed. Empty if a connected part is closed, because that would become hollow.
std::optional<TriangleMesh> offset_wall(const Surface& surface, double half_mm);

/// The most by which a vertex lies farther from the plane of one of its triangles than requested.
inline constexpr double kMostOffsetShare = 1.25;

}  // namespace clay::solid::inline repair
