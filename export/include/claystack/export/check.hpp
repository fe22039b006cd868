#pragma once
#include "claystack/core/result.hpp"
#include "claystack/export/solid.hpp"

#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <limits>
#include <string>
#include <string_view>
#include <vector>

namespace clay::solid::inline check {

// ---- mesh check ----------------------------------------------------------------------
// Is a mesh a solid that prints? The tests know nothing of how the mesh was made.

/// One thing wrong with a mesh, and where.
struct MeshProblem {
  std::string what;       ///< "open edge", "inside out", "self-intersection", ...
  std::string where;      ///< triangle numbers and coordinates in mm, for people
  std::size_t count = 1;  ///< how many of this kind; `where` shows the first
};

struct MeshReport {
  bool closed = false;    ///< no edge has a face on one side only
  bool manifold = false;  ///< no edge of more than two faces, no vertex of two fans
  bool oriented = false;  ///< neighbours agree, and (if closed) normals point out of the clay
  /// Pairs of triangles that meet where they should not; counting stops at 100 000.
  std::size_t self_intersections = 0;
  /// Shells lie beside or inside each other in alternating turns, be it inside out. False too
  /// where that has no meaning: open, crossing itself or with degenerate triangles.
  bool bounds_volume = false;
  std::size_t components = 0;
  std::size_t cavities = 0;    ///< shells that are turned inward, of a mesh that bounds a volume
  double trapped_mm3 = 0.0;    ///< what they enclose: resin or powder stays in
  std::size_t degenerate = 0;  ///< triangles of no area
  std::size_t triangles = 0;
  double volume_mm3 = 0.0;
  bool out_of_memory = false;  ///< the check was abandoned for that, which is no fault of the mesh
  std::vector<MeshProblem> problems;

  [[nodiscard]] bool sound() const noexcept { return problems.empty(); }
};

/// Combinatorics by our own count over the indices; crossings by CGAL's exact predicates on the
/// pairs that a sieve leaves, in parts that all cores share (the report does not depend on how many
/// there are); how several shells lie by one ray from the top of each, with exact predicates too.
/// `check_bench 20000000 1 1` prints time and peak memory of the largest mesh, `check_bench fans`
/// the time that vertices of many triangles take.
/// An inward shell (a closed cavity) is sound when it lies inside an outward one.
MeshReport check_mesh(const TriangleMesh& mesh);

/// Estimate of the memory [bytes] that check_mesh takes beside a mesh of `triangles`: 50 bytes a
/// triangle were measured for one shell of 20 million. Shells that are many, small and nested take
/// up to twice as much.
[[nodiscard]] constexpr std::uint64_t check_memory(std::size_t triangles) noexcept {
  return std::uint64_t{60} * triangles;
}

// ---- mesh wall -----------------------------------------------------------------------
// The wall of a mesh that has no profile: seen from many places, never bounded.

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

// ---- process limits ------------------------------------------------------------------
// What a way of making things asks of walls. Every figure says where it comes from.

/// Holds for objects whose width, depth and height add up to no more than this.
struct WallLimit {
  double up_to_size_sum_mm = 0.0;
  double min_wall_mm = 0.0;
  std::string source;
};

struct ProcessLimits {
  std::string name;
  std::vector<WallLimit> walls;  ///< by rising size; the last holds for all larger objects too

  [[nodiscard]] const WallLimit& wall_for(double size_sum_mm) const noexcept;
};

inline constexpr std::array<std::string_view, 5> kProcessNames{"fdm", "sla", "earthenware",
                                                               "stoneware", "porcelain"};

/// One of kProcessNames; any other name is an error that lists them.
Result<ProcessLimits> process_named(std::string_view name);

/// JSON as in samples/schema/process.schema.json; errors name the file and the field.
Result<ProcessLimits> parse_process(std::string_view bytes, std::string_view file_name);

}  // namespace clay::solid::inline check
