#pragma once
// `claystack import` of a mesh.

#include "app/cli/console.hpp"
#include "app/import/mesh_pot.hpp"

#include <string>

namespace clay::cli {

/// Reads `mesh`, writes `pot`, and reports axis, deviation and the parts that are not of
/// revolution.
Result<void> import_mesh(const std::string& mesh, const std::string& pot,
                         const importing::MeshPotSettings& settings, const Console& console);

}  // namespace clay::cli
