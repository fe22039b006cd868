#pragma once
// The bodies of a mesh: outward shells, each with the cavities inside it.

#include "claystack/export/solid.hpp"

#include <cstdint>
#include <vector>

namespace clay::solid {

/// The triangles of each body, in their order; bodies in the order of their first triangle. A shell
/// that faces inward belongs to the outward shell of least volume whose bounding box contains its
/// own. Requires a sound mesh.
[[nodiscard]] std::vector<std::vector<std::uint32_t>> bodies_of(const TriangleMesh& mesh);

}  // namespace clay::solid
