#include "claystack/export/mesh_estimate.hpp"

#include "export/formats/file_sizes.hpp"
#include "export/formats/stated_sizes.hpp"

namespace clay::solid::inline formats {
namespace {

std::uint64_t usual_triangles(std::uint64_t bytes, MeshFormat format) {
  return static_cast<std::uint64_t>(static_cast<double>(bytes) / usual_bytes_per_triangle(format));
}

}  // namespace

// The decoders were measured on a vase of 1.1 million triangles; the others need less than a check.
MeshEstimate estimate_mesh(std::string_view bytes, MeshFormat format) {
  constexpr std::uint64_t kDracoBytes = 130, kModelBytes = 160;
  switch (format) {
    case MeshFormat::drc:
      return {drc_triangles(bytes, {}).value_or(0), kDracoBytes};
    case MeshFormat::glb:
      return {glb_triangles(bytes), kDracoBytes};
    case MeshFormat::three_mf:
      return {usual_triangles(bytes_of_models_in_3mf(bytes), MeshFormat::three_mf_model),
              kModelBytes};
    case MeshFormat::three_mf_model:
      return {usual_triangles(bytes.size(), format), kModelBytes};
    default:
      return {usual_triangles(bytes.size(), format), 0};
  }
}

}  // namespace clay::solid::inline formats
