#include "export/job/file_estimates.hpp"

#include "claystack/export/proof.hpp"
#include "export/formats/file_sizes.hpp"
#include "export/formats/stl_layout.hpp"

namespace clay::solid::inline job {
namespace {

/// Mesh, encoder and text at their peak, for each triangle; measured on a vase of 2.3 and 4.6
/// million triangles.
std::uint64_t bytes_per_triangle(MeshFormat format, const ExportOptions& options) {
  switch (format) {
    case MeshFormat::stl_binary:
      return 0;
    case MeshFormat::stl_ascii:
      return 460;
    case MeshFormat::obj:
      return options.normals ? 230 : 145;
    case MeshFormat::ply:
      return 100;
    case MeshFormat::drc:
      return 125;
    case MeshFormat::glb:
      return 150;
    default:
      return 210;
  }
}

}  // namespace

std::uint64_t usual_file_bytes(MeshFormat format, const ExportOptions& options,
                               std::size_t triangles) {
  if (format == MeshFormat::stl_binary) return stl::file_bytes(triangles);
  double bytes = usual_bytes_per_triangle(format, options.glb);
  if (format == MeshFormat::obj && options.normals) bytes += 38.0;
  if (format == MeshFormat::ply) bytes += 2.0;  // the walls, of half as many points
  return static_cast<std::uint64_t>(bytes * static_cast<double>(triangles));
}

std::uint64_t mesh_memory(MeshFormat format, const ExportOptions& options, std::size_t triangles) {
  const std::uint64_t whole = bytes_per_triangle(format, options) * triangles;
  if (!options.full_verification) return whole;
  constexpr std::uint64_t kMeshReadBack = 72;  // of a binary STL, which is not held otherwise
  const bool streamed = format == MeshFormat::stl_binary;
  return whole + check_memory(triangles) + (streamed ? kMeshReadBack * triangles : 0);
}

}  // namespace clay::solid::inline job
