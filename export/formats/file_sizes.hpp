#pragma once
// The usual sizes of mesh files: the estimates of exports, and those of readers for a file that
// states its triangles at no fixed place.

#include "claystack/export/formats.hpp"

namespace clay::solid::inline formats {

/// The usual size of a file for each triangle of a closed mesh, which has half as many points
/// [bytes]. Measured on the vase, of 59,800 triangles, with coordinates of usual length; of an OFF
/// and of the model in a 3MF it is less, because other programs write shorter numbers. No reader
/// can infer its triangles from a .drc, .3mf or .glb: some are compressed a hundred times as well.
[[nodiscard]] constexpr double usual_bytes_per_triangle(MeshFormat format,
                                                        GlbMesh glb = GlbMesh::draco) noexcept {
  switch (format) {
    case MeshFormat::stl_binary:
      return 50.0;
    case MeshFormat::stl_ascii:
      return 193.0;
    case MeshFormat::obj:
      return 34.0;
    case MeshFormat::ply:
      return 19.0;
    case MeshFormat::off:
      return 16.0;
    case MeshFormat::three_mf:
      return 12.0;
    case MeshFormat::three_mf_model:
      return 60.0;
    case MeshFormat::glb:
      return glb == GlbMesh::core ? 18.0 : glb == GlbMesh::meshopt ? 2.4 : 0.4;
    case MeshFormat::drc:
      return 0.4;
  }
  return 0.4;
}

}  // namespace clay::solid::inline formats
