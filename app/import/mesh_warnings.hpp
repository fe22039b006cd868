#pragma once
// Warnings about a pot made from a mesh, for the command line and for Python.

#include "app/import/mesh_pot.hpp"

#include "claystack/export/proof.hpp"

#include <optional>
#include <string>
#include <vector>

namespace clay::importing {

/// About a mesh that is not closed or not oriented outward, its noise, rings that are farther from
/// the section than their limit, and rings that do not touch. The name of the mesh is not part of
/// the text. `rings`: the settings with which the pot was made.
std::vector<std::string> mesh_warnings(const MeshPot& made, const solid::MeshEnclosure& enclosure,
                                       const DrawnPotSettings& rings);

/// "the pot is only 3 mm high": of the requested height.
[[nodiscard]] std::optional<std::string> low_pot_warning(const MeshPotSettings& settings);

}  // namespace clay::importing
