#pragma once
// The wall of a mesh that has no profile: seen from many places, never bounded.

#include "claystack/core/result.hpp"
#include "claystack/export/solid.hpp"

#include <cstddef>
#include <cstdint>
#include <functional>
#include <limits>

namespace clay::solid::inline check {

/// What rays found. A sampling and no bound: between the rays the wall may be thinner.
struct SampledWall {
  double least_mm = std::numeric_limits<double>::infinity();  ///< infinite where nothing was hit
  glm::dvec3 place{0.0};       ///< where that ray began, on the surface [mm]
  std::uint32_t triangle = 0;  ///< and on which triangle
  std::size_t rays = 0;        ///< that were followed to their ends
  std::size_t oblique = 0;     ///< met a surface turned more than 45 degrees: an edge, no wall
  std::size_t escaped = 0;     ///< met nothing: the mesh is open there
};

inline constexpr std::size_t kMostWallSamples = 10'000'000;
/// Work for all rays together, in boxes and triangles looked at. A closed mesh takes about a
/// hundred a ray; in a soup of large triangles each ray comes past nearly all of them.
[[nodiscard]] constexpr std::size_t most_wall_steps(std::size_t samples) noexcept {
  return 100'000'000 + 2'000 * samples;
}

/// Thickness along the inward normal from `samples` places on the surface, evenly by area (strata
/// in the order of the triangles, Halton's points within them; always the same), to the first
/// face seen from behind. Faces seen from the front are passed: the ray's own triangle, and
/// neighbours that rounding puts in its way. Where that face is turned more than 45 degrees
/// against the ray, as beside the edge of a rim, the distance tells of no wall and is not counted.
///
/// Where the work is more than `most_steps`, fewer rays are followed, spread over the surface as
/// evenly; `rays` tells how many. `progress` is called with the number of rays done or left out, up
/// to `samples`, from any thread but from one at a time.
///
/// By CGAL's exact predicates. Errors of kind `bad_input`: no triangle with area, a point that is
/// no number, an index out of range, or samples not from 1 to kMostWallSamples; of kind `io` where
/// there is not enough memory; of kind `unsound` where the library gave up.
Result<SampledWall> sampled_wall(const TriangleMesh& mesh, std::size_t samples,
                                 std::size_t most_steps,
                                 const std::function<void(std::size_t)>& progress = {});
inline Result<SampledWall> sampled_wall(const TriangleMesh& mesh, std::size_t samples) {
  return sampled_wall(mesh, samples, most_wall_steps(samples));
}

}  // namespace clay::solid::inline check
