#pragma once
#include "claystack/export/solid.hpp"

namespace clay::bench {

/// CGAL's soup-to-mesh and self-intersection test, with exact predicates. False for sound meshes.
/// Callers must use the result, so that the compiler cannot remove the work.
bool cgal_finds_defect(const solid::TriangleMesh& mesh);

}  // namespace clay::bench
