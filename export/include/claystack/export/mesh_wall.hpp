#pragma once
// The wall of a mesh that has no profile: seen from many places, never bounded.

#include "claystack/engine/result.hpp"
#include "claystack/export/triangle_mesh.hpp"

#include <cstddef>
#include <cstdint>
#include <limits>

namespace clay::solid {

/// What rays found. A sampling and no bound: between the rays the wall may be thinner.
struct SampledWall {
  double least_mm = std::numeric_limits<double>::infinity();  ///< infinite where nothing was hit
  glm::dvec3 place{0.0};       ///< where that ray began, on the surface [mm]
  std::uint32_t triangle = 0;  ///< and on which triangle
  std::size_t rays = 0;        ///< all of them
  std::size_t oblique = 0;     ///< met a surface turned more than 45 degrees: an edge, no wall
  std::size_t escaped = 0;     ///< met nothing: the mesh is open there
};

inline constexpr std::size_t kMostWallSamples = 10'000'000;

/// Thickness along the inward normal from `samples` places on the surface, evenly by area (strata
/// in the order of the triangles, Halton's points within them; always the same), to the first
/// face seen from behind. Faces seen from the front are passed: the ray's own triangle, and
/// neighbours that rounding puts in its way. Where that face is turned more than 45 degrees
/// against the ray, as beside the edge of a rim, the distance tells of no wall and is not counted.
///
/// By CGAL's AABB tree. Errors of kind `bad_input`: no triangle with
/// area, a point that is no number, an index out of range, or samples not from 1 to
/// kMostWallSamples; of kind `unsound` where the library gave up.
Result<SampledWall> sampled_wall(const TriangleMesh& mesh, std::size_t samples);

}  // namespace clay::solid
