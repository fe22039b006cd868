#pragma once
#include "claystack/core/result.hpp"
#include "claystack/export/section.hpp"

#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <glm/vec3.hpp>
#include <vector>

namespace clay::solid {

// ---- triangle mesh -------------------------------------------------------------------

/// The largest mesh that is made, read or checked; as binary STL it takes 1 GB.
inline constexpr std::size_t kMaxTriangles = 20'000'000;

/// Points [mm] and triangles by index, counterclockwise seen from outside.
struct TriangleMesh {
  std::vector<glm::dvec3> points;
  std::vector<std::array<std::uint32_t, 3>> triangles;

  friend bool operator==(const TriangleMesh&, const TriangleMesh&) = default;
};

/// A box along the axes [mm].
struct MeshExtent {
  glm::dvec3 low{0.0}, high{0.0};

  /// Width, depth and height.
  [[nodiscard]] glm::dvec3 size() const noexcept { return high - low; }
};

/// The box around the corners of the triangles: points without a triangle do not count. At the
/// origin if there is no triangle. Indices must be in range.
[[nodiscard]] MeshExtent extent_of(const TriangleMesh& mesh) noexcept;

/// Signed volume [mm^3] by the divergence theorem, summed in double about the first point
/// with compensation; positive for a closed mesh oriented outward. Indices must be in range.
[[nodiscard]] double signed_volume(const TriangleMesh& mesh) noexcept;

// ---- tessellate ----------------------------------------------------------------------

inline constexpr std::size_t kMinSegments = 3;
inline constexpr std::size_t kMaxSegments = std::size_t{1} << 20;

/// Revolves a certified profile in `segments` equal steps about the axis, z up (for printers): the
/// profile's y becomes the mesh's z. Radii carry the equal-volume factor sqrt((2 pi/n) / sin(2
/// pi/n)), so that the mesh holds exactly the clay of the profile. A polygon that never meets the
/// axis gives one shell; any other gives one shell for each part between axis segments (a closed
/// cavity is a shell oriented inward). Vertices are shared, with one for each pole; there is no -0.
/// Requires kMinSegments <= segments <= kMaxSegments and triangle_count() <= kMaxTriangles.
TriangleMesh revolve(const Profile& profile, std::size_t segments);

/// The number of triangles that `revolve` makes.
[[nodiscard]] std::size_t triangle_count(const Profile& profile, std::size_t segments) noexcept;

/// Largest distance [mm] between a circle of radius `radius_mm` and its equal-area n-gon.
[[nodiscard]] double chordal_error_mm(double radius_mm, std::size_t segments) noexcept;

/// The smallest number of segments (at least 8, a multiple of 4) whose chordal error is within the
/// tolerance; kMaxSegments if even that exceeds it.
[[nodiscard]] std::size_t segments_for(double radius_mm, double tolerance_mm) noexcept;

// ---- boundary for CAD ----------------------------------------------------------------

/// The walls in a STEP file. `spline`: one smooth surface for each wall between sharp corners,
/// within the tolerance of the section. `lines`: the section exactly, with a cone, cylinder or
/// plane for each of its edges.
enum class StepWalls { spline, lines };

/// The remedy that messages name where curves do not keep within the tolerance: StepWalls::lines.
inline constexpr const char* kLinesAreExact = "straight lines instead of curves are exact";

// ---- decimate ------------------------------------------------------------------------
// Fewer triangles for meshes that have no profile to revolve again.

struct DecimatedMesh {
  TriangleMesh mesh;  ///< on points of the input mesh
  /// The largest distance from a vertex of either mesh to the surface of the other. Measured at the
  /// vertices only; between them the surfaces may be farther apart.
  double max_error_mm = 0.0;
};

struct DecimateOptions {
  /// Called repeatedly with the share of the work that is done, 0 to 1.
  std::function<void(double share)> progress = {};
  /// Called repeatedly, from several threads. True ends the work: an error of kind `io`,
  /// "decimation stopped: cancelled".
  std::function<bool()> cancelled = {};
};

inline constexpr std::size_t kFewestTriangles = 4;

/// Reduces to at most `max_triangles` by collapsing edges in the order of OpenMesh's error quadrics
/// (Garland, Heckbert, "Surface simplification using quadric error metrics"); no collapse may flip
/// a face. A mesh within the limit is returned unchanged. Walls may come to intersect: check the
/// result. Errors of kind `unsound`: the mesh is not a closed, oriented manifold; `bad_input`: a
/// limit below 4, or below the minimum that this mesh can reach (the message states it); `io`: not
/// enough memory, cancelled, or the library failed.
Result<DecimatedMesh> decimate(const TriangleMesh& sound_mesh, std::size_t max_triangles,
                               const DecimateOptions& options = {});

}  // namespace clay::solid
