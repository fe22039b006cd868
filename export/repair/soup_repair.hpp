#pragma once
// The part of a repair that needs no half-edges: selects triangles and points.

#include "claystack/export/repair.hpp"

#include <string_view>

namespace clay::solid::inline repair {

/// Adds one entry for each kind; none for a count of 0.
void note_repair(std::vector<Repair>& repaired, std::string_view what, std::size_t count);

/// Removes and welds until every triangle has three distinct points and no two triangles are equal;
/// removes fins and unused points.
void clean_soup(TriangleMesh& mesh, std::vector<Repair>& repaired);

}  // namespace clay::solid::inline repair
