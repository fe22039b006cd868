#pragma once
#include "claystack/export/proof.hpp"

namespace clay::solid::inline proof {

/// As check_mesh, but a failed check throws, std::bad_alloc for example.
[[nodiscard]] MeshReport inspect_mesh(const TriangleMesh& mesh);

}  // namespace clay::solid::inline proof
