// Replaces meshopt_view.cpp and glb_meshopt.cpp in builds without meshoptimizer.

#include "export/formats/glb_packed.hpp"
#include "export/formats/meshopt_view.hpp"

namespace clay::solid::inline formats::glb {

Result<Packed> packed_by_meshopt(const TriangleMesh&, std::span<const Colour16>,
                                 const DracoSettings&) {
  return failure(ErrorKind::bad_input, "cannot write .glb: this build has no meshoptimizer");
}

Result<std::string> unpacked_by_meshopt(std::string_view, const MeshoptView&) {
  return failure(ErrorKind::bad_input, "EXT_meshopt_compression: this build has no meshoptimizer");
}

}  // namespace clay::solid::inline formats::glb
