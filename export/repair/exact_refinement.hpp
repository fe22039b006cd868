#pragma once
// Cuts the triangles of a soup where they meet, with exact constructions (CGAL).

#include "claystack/core/result.hpp"
#include "export/repair/exact_soup.hpp"
#include "export/repair/stage_report.hpp"

namespace clay::solid::inline repair {

/// Above this number of intersecting pairs, the exact numbers would need too much memory and time.
inline constexpr std::size_t kMostCuts = 400'000;

/// Triangles on the same vertices are added up by direction and those without area are left out.
/// Triangles that meet no other keep their points and their order. Overlapping coplanar triangles
/// share one triangulation, so that both are cut alike. Requires finite points and indices in
/// range. An error (`unsound`) above kMostCuts.
Result<ExactSoup> refine(const TriangleMesh& soup, StageReport& stage);

}  // namespace clay::solid::inline repair
