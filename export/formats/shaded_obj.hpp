#pragma once
#include "claystack/export/solid.hpp"
#include "export/solid/revolve_layout.hpp"

#include <string>
#include <string_view>

namespace clay::solid::inline formats {

/// Like `encode_obj(mesh)` for the mesh of a revolve, with a normal for each corner of a face: that
/// of the surface of revolution, shared where the profile bends by less than 30 degrees, so that
/// walls look round and rims stay edges.
std::string encode_shaded_obj(const RevolveLayout& rule, const TriangleMesh& mesh,
                              std::string_view object_name);

}  // namespace clay::solid::inline formats
