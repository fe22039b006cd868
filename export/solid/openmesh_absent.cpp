// Replaces decimate.cpp and seam_cure.cpp in builds without OpenMesh.

#include "claystack/export/solid.hpp"
#include "export/solid/seam_cure.hpp"

namespace clay::solid {

Result<DecimatedMesh> decimate(const TriangleMesh&, std::size_t, const DecimateOptions&) {
  return failure(ErrorKind::bad_input, "cannot reduce the triangles: this build has no OpenMesh");
}

Result<CuredMesh> cure_seam(const TriangleMesh&, const std::vector<bool>&, double) {
  return failure(ErrorKind::bad_input,
                 "cannot join the parts of a fallen pot: this build has no OpenMesh");
}

}  // namespace clay::solid
