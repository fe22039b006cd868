// Replaces mesh_union.cpp in builds without GMP: in a web page. Without it, the exact points grow
// beyond the range of doubles before they are rounded.

#include "export/fallen/mesh_union.hpp"

namespace clay::solid::inline fallen {

Result<MeshUnion> unite(const TriangleMesh&, const TriangleMesh&) {
  return failure(ErrorKind::bad_input,
                 "cannot export a fallen pot: this build has no exact numbers (GMP) for the union "
                 "of its parts; save the pot and export it with the native program");
}

}  // namespace clay::solid::inline fallen
