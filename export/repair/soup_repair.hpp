#pragma once
// The part of a repair that needs no half-edges: which triangles stay, and on which points.

#include "claystack/export/repair.hpp"

#include <string_view>

namespace clay::solid::inline repair {

/// One entry for each kind, none for a count of 0.
void note_repair(std::vector<Repair>& repaired, std::string_view what, std::size_t count);

/// Drops and welds until every triangle has three points of its own and no two triangles are the
/// same; takes fins off. Points that no triangle uses go too.
void clean_soup(TriangleMesh& mesh, std::vector<Repair>& repaired);

}  // namespace clay::solid::inline repair
