#pragma once
#include "claystack/export/repair.hpp"

#include <vector>

namespace clay::solid::inline repair {

/// Of triangles on the same vertices one is kept if one orientation prevails; if both are equally
/// frequent they lie back to back, and none is kept. Where solids share a face, and both lie on the
/// same side of it, each keeps its own: without it, a solid would be open.
void drop_duplicates(TriangleMesh& mesh, std::vector<Repair>& repaired);

}  // namespace clay::solid::inline repair
