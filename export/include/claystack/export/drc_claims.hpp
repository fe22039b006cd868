#pragma once
// What a Draco file of ours states of the solid in it, as metadata that other decoders pass over:
//   claystack.volume_mm3, .volume_bound_mm3, .counted_volume_mm3, .vertex_error_mm   float64
//   claystack.checksum   XXH3-128 of the file without these 32 hexadecimal digits

#include "claystack/engine/result.hpp"
#include "claystack/export/mesh_check.hpp"
#include "claystack/export/triangle_mesh.hpp"

#include <optional>
#include <string_view>
#include <vector>

namespace clay::solid {

/// Finite, and none below 0.
struct DracoClaims {
  double volume_mm3 = 0.0;          ///< of the solid before it was encoded
  double volume_bound_mm3 = 0.0;    ///< the decoded mesh's volume is within this of it
  double counted_volume_mm3 = 0.0;  ///< of the stack that the solid was made of
  double vertex_error_mm = 0.0;     ///< no vertex is farther from where it was

  friend bool operator==(const DracoClaims&, const DracoClaims&) = default;
};

/// What the file states, after the checksum has been found to hold; nothing for files of others.
/// Errors as those of `decode_drc`: header, metadata and checksum are checked, not the mesh.
Result<std::optional<DracoClaims>> drc_claims(std::string_view bytes, std::string_view name);

/// One problem where the volume is farther than stated from the one stated (but for what adding it
/// up in double costs, 1e-9 of it); none where the mesh keeps what its file states.
[[nodiscard]] std::vector<MeshProblem> compare_with_claims(const TriangleMesh& decoded,
                                                           const DracoClaims& claims);

}  // namespace clay::solid
