#pragma once
#include "claystack/export/solid.hpp"

namespace clay::bench {

/// CGAL's soup-to-mesh and self-intersection test, with exact predicates. False on sound meshes;
/// callers use the result, so that the compiler cannot remove the work.
bool cgal_finds_fault(const solid::TriangleMesh& mesh);

}  // namespace clay::bench
