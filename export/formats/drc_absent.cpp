// Replaces drc.cpp in builds without Draco.

#include "claystack/export/formats.hpp"
#include "export/formats/mesh_limits.hpp"

namespace clay::solid::inline formats {

Result<std::string> encode_drc(const TriangleMesh&, const DracoSettings&, const DracoClaims*) {
  return failure(ErrorKind::bad_input, "cannot write .drc: this build has no Draco");
}

Result<TriangleMesh> decode_drc(std::string_view, std::string_view name) {
  return bad_file(name, "cannot read .drc: this build has no Draco");
}

Result<std::size_t> drc_triangles(std::string_view, std::string_view name) {
  return bad_file(name, "cannot read .drc: this build has no Draco");
}

Result<std::optional<DracoClaims>> drc_claims(std::string_view, std::string_view name) {
  return bad_file(name, "cannot read .drc: this build has no Draco");
}

}  // namespace clay::solid::inline formats
