#pragma once
#include "claystack/export/solid.hpp"

namespace clay::bench {

/// CGAL's soup-to-mesh and self-intersection test, with exact predicates. False on sound meshes;
/// whoever measures looks at it, so that the work cannot be left out.
bool cgal_finds_fault(const solid::TriangleMesh& mesh);

}  // namespace clay::bench
