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
// Checks whether a mesh is a printable solid, independently of how the mesh was made.

/// One defect of a mesh, and its place.
struct MeshProblem {
  std::string what;       ///< "open edge", "inside out", "self-intersection", ...
  std::string where;      ///< triangle numbers and coordinates in mm, for people
  std::size_t count = 1;  ///< how many of this kind; `where` shows the first
};

struct MeshReport {
  bool closed = false;    ///< no edge has only one face
  bool manifold = false;  ///< no edge of more than two faces, no vertex with two fans
  bool oriented = false;  ///< neighbours agree, and (if closed) normals point out of the clay
  /// Pairs of triangles that intersect outside shared edges and vertices; counting stops at 100
  /// 000.
  std::size_t self_intersections = 0;
  /// Shells lie beside or inside each other with alternating orientation, possibly inside out. Also
  /// false where this is undefined: open, self-intersecting or with degenerate triangles.
  bool bounds_volume = false;
  std::size_t components = 0;
  std::size_t cavities = 0;    ///< inward shells of a mesh that bounds a volume
  double trapped_mm3 = 0.0;    ///< the volume they enclose, which traps resin or powder
  std::size_t degenerate = 0;  ///< triangles of zero area
  std::size_t triangles = 0;
  double volume_mm3 = 0.0;
  bool out_of_memory =
      false;  ///< the check stopped for lack of memory, which is no fault of the mesh
  std::vector<MeshProblem> problems;

  [[nodiscard]] bool sound() const noexcept { return problems.empty(); }
};

/// Topology is counted on the indices; intersections use CGAL's exact predicates on the pairs that
/// a broad phase leaves, in parts shared by all cores (the report does not depend on their number);
/// the nesting of shells uses one ray from the top of each, also with exact predicates.
/// `check_bench 20000000 1 1` prints time and peak memory for the largest mesh, `check_bench fans`
/// the time for vertices of many triangles. An inward shell (a closed cavity) is sound if it lies
/// inside an outward one.
MeshReport check_mesh(const TriangleMesh& mesh);

/// Estimated memory [bytes] of check_mesh in addition to a mesh of `triangles`: 50 bytes per
/// triangle were measured for one shell of 20 million. Many small, nested shells take up to twice
/// as much.
[[nodiscard]] constexpr std::uint64_t check_memory(std::size_t triangles) noexcept {
  return std::uint64_t{60} * triangles;
}

// ---- mesh wall -----------------------------------------------------------------------
// The wall of a mesh that has no profile: sampled at many points, not bounded.

/// The result of the rays: sampled values, not a bound. Between the rays the wall may be thinner.
struct SampledWall {
  double least_mm = std::numeric_limits<double>::infinity();  ///< infinite if nothing was hit
  glm::dvec3 place{0.0};       ///< the start of that ray on the surface [mm]
  std::uint32_t triangle = 0;  ///< the triangle it started on
  std::size_t rays = 0;        ///< rays followed to their ends
  std::size_t oblique = 0;  ///< hit a surface turned by more than 45 degrees: an edge, not a wall
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
/// beside the edge of a rim, the distance is not a wall thickness and is not counted.
///
/// If the work exceeds `most_steps`, fewer rays are followed, still evenly distributed; `rays`
/// holds their number. `progress` is called with the number of rays done or skipped, up to
/// `samples`, from any thread but never concurrently.
///
/// Uses CGAL's exact predicates. Errors of kind `bad_input`: no triangle with area, a point that is
/// not finite, an index out of range, or `samples` outside 1 to kMostWallSamples; of kind `io`: not
/// enough memory; of kind `unsound`: the library failed.
Result<SampledWall> sampled_wall(const TriangleMesh& mesh, std::size_t samples,
                                 std::size_t most_steps,
                                 const std::function<void(std::size_t)>& progress = {});
inline Result<SampledWall> sampled_wall(const TriangleMesh& mesh, std::size_t samples) {
  return sampled_wall(mesh, samples, most_wall_steps(samples));
}

// ---- process limits ------------------------------------------------------------------
// The minimum walls of a manufacturing process. Every figure names its source.

/// Applies to objects whose width, depth and height add up to at most this.
struct WallLimit {
  double up_to_size_sum_mm = 0.0;
  double min_wall_mm = 0.0;
  std::string source;
};

struct ProcessLimits {
  std::string name;
  std::vector<WallLimit>
      walls;  ///< by increasing size; the last also applies to all larger objects

  [[nodiscard]] const WallLimit& wall_for(double size_sum_mm) const noexcept;
};

inline constexpr std::array<std::string_view, 5> kProcessNames{"fdm", "sla", "earthenware",
                                                               "stoneware", "porcelain"};

/// One of kProcessNames; any other name is an error that lists them.
Result<ProcessLimits> process_named(std::string_view name);

/// JSON as in samples/schema/process.schema.json; errors name the file and the field.
Result<ProcessLimits> parse_process(std::string_view bytes, std::string_view file_name);

}  // namespace clay::solid::inline check
