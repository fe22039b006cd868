#pragma once
// Converts meshes to and from Draco's.

#include "claystack/core/result.hpp"
#include "claystack/export/formats.hpp"
#include "claystack/export/solid.hpp"
#include "export/formats/draco_grid.hpp"

#include <draco/mesh/mesh.h>
#include <array>
#include <cstdint>
#include <glm/vec3.hpp>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace clay::solid::inline formats {

/// The triangles of `mesh` on `points`, its points as float32; indices are in range.
/// `colours`: one for each point, or none.
[[nodiscard]] std::unique_ptr<draco::Mesh> to_draco(
    const TriangleMesh& mesh, const std::vector<glm::vec3>& points,
    std::span<const std::array<std::uint16_t, 4>> colours = {});

/// A stream as `encode_drc` makes it without claims, with the counts and bounds of the decoded
/// mesh.
struct EncodedDraco {
  std::string bytes;
  std::size_t points = 0, triangles = 0;
  glm::vec3 low{0.0F}, high{0.0F};  ///< of the decoded points
};
/// For a part of another file, which may be in another unit.
[[nodiscard]] Result<EncodedDraco> encode_draco(
    const TriangleMesh& mesh, const DracoSettings& settings,
    std::span<const std::array<std::uint16_t, 4>> colours, const GridFile& file);

/// Checks everything: Draco's decoder returns sizes, maps and indices as the file states them.
/// Corners share a point if Draco maps them to one position.
[[nodiscard]] Result<TriangleMesh> from_draco(const draco::Mesh& mesh, std::string_view name);

}  // namespace clay::solid::inline formats
