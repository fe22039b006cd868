#pragma once
#include "claystack/export/solid.hpp"

namespace clay::solid::inline repair {

/// A new surface around all triangles, at `offset_mm` outside of them, which enters openings wider
/// than about `alpha_mm`, the size of its triangles. Its points have that distance; where it is
/// curved, the middles of its triangles are nearer. It is closed and does not intersect itself;
/// details smaller than the offset are lost. CGAL's alpha wrapping (Portaneri, Rouxel-Labbé,
/// Hemmer, Cohen-Steiner and Alliez, "Alpha wrapping with an offset", 2022). Points are rounded to
/// float32.
TriangleMesh wrapped(const TriangleMesh& soup, double offset_mm, double alpha_mm);

/// The smallest `offset_mm` of `wrapped` that is worth its time. A wrap of an open surface has some
/// 2.7 triangles for each square of the size `alpha_per_offset * offset_mm` on one side of it
/// (measured; fewer around a closed one), and each takes some 0.4 ms of processor time. The number
/// of triangles is bounded by kMostWrapTriangles. Requires points and indices that are valid.
[[nodiscard]] double least_wrap_offset_mm(const TriangleMesh& soup, double alpha_per_offset);

/// By the figures above a wrap with that many takes about three minutes (an estimate).
inline constexpr double kMostWrapTriangles = 500'000.0;

/// The area of all triangles [mm2].
[[nodiscard]] double area_mm2(const TriangleMesh& soup);

}  // namespace clay::solid::inline repair
