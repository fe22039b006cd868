#pragma once
// The use of a foreign mesh: whether it prints without being sound, its undersides, and the
// thickness of its walls.

#include "claystack/core/result.hpp"
#include "claystack/export/proof.hpp"
#include "claystack/export/solid.hpp"

#include <cstddef>
#include <cstdint>
#include <functional>
#include <limits>
#include <optional>

namespace clay::solid::inline check {

/// Chosen by judgement: of the meshes of docs/repair.md (Real meshes) whose only fault is
/// self-intersection, half have fewer pairs.
inline constexpr std::size_t kMostUnitedPairs = 200;

/// Whether a slicer makes one body of a mesh that is not sound (`report` is on it): it is closed,
/// every shell is oriented outward, and its only faults are at most kMostUnitedPairs
/// self-intersections, shells inside others, vertices shared by two fans, and triangles without
/// area. A rule, not a proof: more pairs may print, too.
[[nodiscard]] bool slicer_unites(const TriangleMesh& mesh, const MeshReport& report);

/// Parts in mid-air, which a printer cannot hold up without supports.
struct HangingParts {
  std::size_t parts = 0;    ///< connected parts of the mesh
  std::size_t hanging = 0;  ///< parts, or groups of touching parts, that hang
  double lowest_mm = 0.0;   ///< height of the lowest point of the hanging parts above the bed
};

/// The bed is at the lowest point of the mesh. A part stands if it comes within 0.05 mm of the bed,
/// if it meets a standing part (also after a drop of 0.05 mm), or if it lies in the clay of one, as
/// a cavity does. Empty if all parts stand, or if `report`, which is on this mesh, does not decide
/// where the clay is.
[[nodiscard]] std::optional<HangingParts> hanging_parts(const TriangleMesh& mesh,
                                                        const MeshReport& report);

/// The overhang of a mesh, z up.
struct MeshOverhang {
  double angle_deg = 0.0;  ///< 0 without undersides
  glm::dvec3 at{0.0};      ///< [mm]
  double height_mm = 0.0;  ///< of `at` above the bed
};

/// By the same rule as `steepest_overhang` of a profile. The places are 100,000 points, evenly
/// distributed over the area of all triangles that face down; the bed is the lowest level. Empty if
/// a point of a triangle is not finite, or an index out of range.
[[nodiscard]] std::optional<MeshOverhang> steepest_overhang(const TriangleMesh& mesh);

// ---- sampled walls -------------------------------------------------------------------
// The wall of a mesh that has no profile: sampled at many points, not bounded.

/// The result of the rays: sampled values, not a bound. Between the rays the wall may be thinner.
struct SampledWall {
  double least_mm = std::numeric_limits<double>::infinity();  ///< infinite if nothing was hit
  glm::dvec3 place{0.0};       ///< the start of that ray on the surface [mm]
  std::uint32_t triangle = 0;  ///< the triangle it started on
  std::size_t rays = 0;        ///< rays followed to their ends
  /// At an edge, not a wall: hit a surface turned by more than 45 degrees; or thinner than all
  /// before, with too little boundary around the end of the clay.
  std::size_t oblique = 0;
  std::size_t escaped = 0;  ///< hit nothing: the mesh is open there
};

inline constexpr std::size_t kMostWallSamples = 10'000'000;
/// Limit of work for all rays together, in visited boxes and triangles. A ray in a closed mesh
/// takes about a hundred; in a soup of large triangles each ray visits nearly all of them.
[[nodiscard]] constexpr std::size_t most_wall_steps(std::size_t samples) noexcept {
  return 100'000'000 + 2'000 * samples;
}

/// Thickness along the inward normal from `samples` points on the surface to the first back face.
/// The points are evenly distributed by area (strata in the order of the triangles, Halton points
/// within them; deterministic). Front faces are passed: the ray's own triangle, and neighbours that
/// rounding puts in its way. If the back face is turned by more than 45 degrees against the ray, as
/// beside the edge of a rim, the distance is not a wall thickness and is not counted. Neither is it
/// where the clay ends on one side only within so little that the boundary around the end is
/// shorter than three thicknesses: such ends of lips and flanges are no walls for `min_wall`
/// either. In a body where that holds for every ray, the thickest place is reported: twice the
/// distance from the middle of a ray to the nearest face.
///
/// If the work exceeds `most_steps`, fewer rays are followed, still evenly distributed; `rays`
/// holds their number. `progress` is called with the number of rays done or skipped, up to
/// `samples`, from any thread but never concurrently.
///
/// Uses CGAL's exact predicates. Errors of kind `bad_input`: no triangle with area, a point that is
/// not finite, an index out of range, or `samples` outside 1 to kMostWallSamples; of kind `io`: not
/// enough memory, or the library failed.
Result<SampledWall> sampled_wall(const TriangleMesh& mesh, std::size_t samples,
                                 std::size_t most_steps,
                                 const std::function<void(std::size_t)>& progress = {});
inline Result<SampledWall> sampled_wall(const TriangleMesh& mesh, std::size_t samples) {
  return sampled_wall(mesh, samples, most_wall_steps(samples));
}

}  // namespace clay::solid::inline check
