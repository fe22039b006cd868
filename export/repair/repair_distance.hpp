#pragma once
#include "claystack/export/repair.hpp"

namespace clay::solid::inline repair {

/// Upper bounds of the distances between two meshes, each with a triangle with area. Triangles that
/// both have are skipped. The others are divided until the bound is within 2 % of the
/// distance plus `tolerance_mm` of it, or the work exceeds a limit; the result is a bound in either
/// case.
SurfaceChange surface_change(const TriangleMesh& before, const TriangleMesh& after,
                             double tolerance_mm);

}  // namespace clay::solid::inline repair
