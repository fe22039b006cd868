#pragma once
// Meshes whose numbers are probably not millimetres.

#include "claystack/export/formats.hpp"

#include <glm/vec3.hpp>
#include <optional>
#include <string>

namespace clay::cli {

/// A warning if a mesh of this size [mm] is probably in another unit: below 10 mm or above 1 m.
/// Formats that state their unit get it too, because some programs state a wrong one.
[[nodiscard]] std::optional<std::string> doubted_unit(const glm::dvec3& size_mm,
                                                      solid::MeshFormat format);

}  // namespace clay::cli
