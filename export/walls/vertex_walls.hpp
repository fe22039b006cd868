#pragma once
// Wall thickness at the vertices of a profile, for files that hold it as a colour or a number.

#include "claystack/export/section.hpp"

#include <vector>

namespace clay::solid::inline walls {

/// For every polygon, the thickness [mm] at each of its vertices: the smaller of both faces that
/// meet there. A vertex without a wall (at a lip or an edge; see `min_wall`) has the thickness of
/// the nearest one along the polygon that has a wall; in a piece without any, `min_wall`. Finite.
[[nodiscard]] std::vector<std::vector<double>> vertex_walls(const Profile& profile);

/// The thickness [mm] at each vertex of a polygon, or `below_mm` where it is not less. Takes little
/// time where few vertices are thinner.
[[nodiscard]] std::vector<double> thin_vertex_walls(const Polygon& polygon, double below_mm);

}  // namespace clay::solid::inline walls
