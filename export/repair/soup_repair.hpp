#pragma once
// The part of a repair that needs no half-edges: selects triangles and points.

#include "claystack/export/repair.hpp"

#include <optional>
#include <string_view>

namespace clay::solid::inline repair {

/// Adds one entry for each kind; none for a count of 0.
void note_repair(std::vector<Repair>& repaired, std::string_view what, std::size_t count);

/// Removes triangles with an index out of range or a point that is not finite. Returns their
/// number.
std::size_t drop_unusable(TriangleMesh& mesh);

/// Replaces vertices in all triangles.
void renumber(TriangleMesh& mesh, const std::vector<std::uint32_t>& number);

/// Of a mesh with finite float32 points. Returns the number of points that were merged.
std::size_t merge_equal_points(TriangleMesh& mesh);

/// Removes triangles that use a vertex twice. Returns their number.
std::size_t drop_collapsed(TriangleMesh& mesh);

/// Rounds points to float32, removes and welds until every triangle has three distinct points and
/// no two triangles are equal; removes fins and unused points. For `weld_mm` see RepairOptions.
void clean_soup(TriangleMesh& mesh, std::optional<double> weld_mm, std::vector<Repair>& repaired);

}  // namespace clay::solid::inline repair
