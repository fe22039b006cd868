#pragma once
// Converts meshes to and from Draco's.

#include "claystack/core/result.hpp"
#include "claystack/export/solid.hpp"

#include <draco/mesh/mesh.h>
#include <glm/vec3.hpp>
#include <memory>
#include <string_view>
#include <vector>

namespace clay::solid::inline formats {

/// The triangles of `mesh` on `points`, its points as float32; indices are in range.
[[nodiscard]] std::unique_ptr<draco::Mesh> to_draco(const TriangleMesh& mesh,
                                                    const std::vector<glm::vec3>& points);

/// Checks everything: Draco's decoder returns sizes, maps and indices as the file states them.
/// Corners share a point if Draco maps them to one position.
[[nodiscard]] Result<TriangleMesh> from_draco(const draco::Mesh& mesh, std::string_view name);

}  // namespace clay::solid::inline formats
