#pragma once
#include "claystack/core/result.hpp"
#include "claystack/export/repair.hpp"
#include "export/repair/stage_report.hpp"

namespace clay::solid::inline repair {

/// Whether parts that are turned inside out, and so count as empty, are accepted.
enum class Reversed { accepted, refused };

/// For closed sheets of float32 points, in any position: the boundary of the region that they
/// enclose, rounded to float32, and sound by check_mesh. The sheets are cut where they meet, and
/// the outer skin is kept; where parts touch in an edge or a vertex, they are pulled apart by a few
/// units of the last place. Low triangles at the cuts are removed before rounding, in steps up to
/// 2^13 units of the last place until the result is sound; if none is, the best one is cut again.
/// Triangles that meet no other keep their points. In later rounds, the points at cuts are first
/// rounded to a coarser grid, up to 2^15 units of the last place, so that sheets that nearly
/// coincide do so exactly. An error (`unsound`) if the sheets are not closed, enclose nothing, have
/// a part that is refused, or are not sound after kMostRounds.
Result<TriangleMesh> resolve_intersections(const TriangleMesh& closed, Reversed reversed,
                                           std::vector<Repair>& repaired, StageReport& stage);

inline constexpr int kMostRounds = 5;

}  // namespace clay::solid::inline repair
