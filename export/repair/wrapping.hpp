#pragma once
#include "claystack/export/solid.hpp"

namespace clay::solid::inline repair {

/// A new surface around all triangles, at `offset_mm` outside of them, which enters
/// openings wider than about `alpha_per_offset` times that. It is closed and does not intersect
/// itself; details smaller than the offset are lost. CGAL's alpha wrapping (Portaneri,
/// Rouxel-Labbé, Hemmer, Cohen-Steiner and Alliez, "Alpha wrapping with an offset", 2022). Points
/// are rounded to float32.
TriangleMesh wrapped(const TriangleMesh& soup, double offset_mm, double alpha_per_offset);

}  // namespace clay::solid::inline repair
