#pragma once
#include "claystack/core/result.hpp"
#include "claystack/export/formats.hpp"
#include "claystack/export/section.hpp"
#include "claystack/export/solid.hpp"

#include <cstddef>
#include <cstdint>
#include <glm/vec3.hpp>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace clay::solid::inline proof {

// ---- certificate ---------------------------------------------------------------------
// The proof in the plane. For every n >= 3 the n-gon revolve of a profile is closed and embedded if
// each polygon is strictly simple, the polygons are disjoint, and they meet the axis only in
// segments of positive length (each sector is a prism over the profile with rho scaled by
// cos(pi/n), and a homeomorphism maps the smooth revolve to the polygonal one).

struct PlanarCertificate {
  std::size_t polygons = 0;
  std::size_t vertices = 0;
  std::size_t axis_segments = 0;
};

/// Uses exact predicates throughout. The error (kind `unsound`) names the first place that fails.
/// Designed for sections of stacks, which have few edges at any height: more than 1000 are an
/// error.
Result<PlanarCertificate> certify(const Profile& profile);

// ---- solid certificate ---------------------------------------------------------------
// The claims about a file that holds a revolve, with all data needed to prove them again from the
// file's bytes: the profile, the displacement of its vertices by the format's rounding, and the
// margins that cover it.

/// The displacement of vertices that cannot make triangles meet: less than an eighth of the smaller
/// value, for at least 8 segments. That no two disjoint parts meet within half of the distance is a
/// lemma on simplexwise linear maps; the further factor of 4 covers triangles that share a vertex,
/// and is confirmed by tests against CGAL's exact predicates.
struct Margins {
  double clearance_mm = 0.0;  ///< between a vertex of the profile and an edge not incident to it
  double chord_mm = 0.0;      ///< on the smallest circle: r sin(2 pi/n)
  std::size_t segments = 0;

  [[nodiscard]] double safe_rounding_mm() const noexcept;
  friend bool operator==(const Margins&, const Margins&) = default;
};

[[nodiscard]] Margins margins_of(const Profile& profile, std::size_t segments);

enum class Proof {
  margins,    ///< the profile is simple, and its margins cover the rounding
  exact_test  ///< they do not, but no two triangles of the file intersect by CGAL's exact
              ///< predicates
};

struct SolidCertificate {
  std::string format;        ///< as `name_of` spells it
  std::uint64_t bytes = 0;   ///< of the file
  std::string content_hash;  ///< XXH3-128 of the file
  std::string profile_hash;  ///< XXH3-128 of the coordinates, little-endian
  Proof proof = Proof::margins;
  Profile profile;
  std::size_t segments = 0;
  double rounding_mm = 0.0;  ///< maximum displacement of a vertex of the file
  Margins margins;
  double wall_lower_mm = 0.0;       ///< lower bound of the minimum wall of the file's solid
  double wall_upper_mm = 0.0;       ///< upper bound of it
  double volume_mm3 = 0.0;          ///< of the solid before rounding
  double volume_bound_mm3 = 0.0;    ///< the file's volume is within this of `volume_mm3`
  double counted_volume_mm3 = 0.0;  ///< of the stack

  friend bool operator==(const SolidCertificate&, const SolidCertificate&) = default;
};

/// All claims except those on the bytes of a file. Requires a certified `profile` and `rounding_mm`
/// as an upper bound of vertex displacement. The wall of an n-gon revolve is that of the profile
/// with rho scaled by f cos(pi/n) in the middle of a facet and by f at its sides, f being the
/// equal-volume factor. The volume changes by less than the rounding times the area, which includes
/// the possible increase by rounding.
SolidCertificate claims_of(const Profile& profile, std::size_t segments, double rounding_mm);

/// Proves every claim again and compares the file with them: size and hashes, number of triangles,
/// profile, margins (or the exact test), walls, volume; then each triangle of the decoded file with
/// the revolve of the profile. The error (kind `unsound`) names the first claim that fails; an
/// unreadable file is `bad_input`. Certificates may be untrusted.
Result<void> verify_certificate(const SolidCertificate& certificate, std::string_view file_bytes,
                                std::string_view file_name);

/// The largest file that `parse_certificate` reads. A point takes about 40 bytes: enough for every
/// mesh of at most kMaxTriangles with 8 segments or more.
inline constexpr std::size_t kMaxCertificateBytes = std::size_t{1} << 26;

/// JSON. Equal certificates give equal bytes; the reader is strict, and its errors name the field.
std::string write_certificate(const SolidCertificate& certificate);
Result<SolidCertificate> parse_certificate(std::string_view bytes, std::string_view name);

// ---- mesh check ----------------------------------------------------------------------
// Checks whether a mesh is a printable solid, independently of how the mesh was made.

/// One defect of a mesh, and its place.
struct MeshProblem {
  std::string what;       ///< "open edge", "inside out", "self-intersection", ...
  std::string where;      ///< triangle numbers from 1 and coordinates in mm, for people
  std::size_t count = 1;  ///< number of this kind; `where` shows the first
  bool at_least = false;  ///< counting stopped at `count`
};

struct MeshReport {
  bool closed = false;    ///< no edge has only one face
  bool manifold = false;  ///< no edge of more than two faces, no vertex with two fans
  bool oriented = false;  ///< neighbours agree, and (with a volume) normals point out of the clay
  /// Pairs of triangles that intersect outside shared edges and vertices; counting stops at
  /// 100,000.
  std::size_t self_intersections = 0;
  /// Shells lie beside or inside each other with alternating orientation, possibly inside out. Also
  /// false where this is undefined: open, self-intersecting or with degenerate triangles.
  bool bounds_volume = false;
  std::size_t components = 0;
  std::size_t cavities = 0;  ///< inward shells of a mesh that bounds a volume
  /// The volume that they enclose, without the bodies in them: it traps resin or powder.
  double trapped_mm3 = 0.0;
  std::size_t degenerate = 0;  ///< triangles of zero area
  std::size_t triangles = 0;
  /// Closed, neighbours agree, and the faces at each edge of more than two are half of either
  /// direction; any other volume is undefined.
  bool has_volume = false;
  double volume_mm3 = 0.0;  ///< the sum over the triangles; meaningless without a volume
  double area_mm2 = 0.0;    ///< of all triangles
  glm::dvec3 size_mm{0.0};  ///< width, depth and height, without points that no triangle uses
  std::vector<MeshProblem> problems;

  [[nodiscard]] bool sound() const noexcept { return problems.empty(); }
};

/// Topology is counted on the indices; intersections use CGAL's exact predicates on the pairs that
/// a broad phase leaves, in parts shared by all cores (the report does not depend on their number);
/// the nesting of shells uses one ray from the top of each, also with exact predicates.
/// `check_bench 20000000 1 1` prints time and peak memory for the largest mesh, `check_bench fans`
/// the time for vertices of many triangles. An inward shell (a closed cavity) is sound if it lies
/// inside an outward one. An error (io) is no fault of the mesh: not enough memory, or a library
/// failed.
Result<MeshReport> check_mesh(const TriangleMesh& mesh);

/// Whether the triangles of a mesh enclose a volume, by their edges alone: no test for
/// intersections, vertices or shells, and so much faster than `check_mesh`.
struct MeshEnclosure {
  std::size_t open_edges = 0;                ///< of one triangle only
  std::size_t flipped_edges = 0;             ///< edges of two triangles that face opposite ways
  glm::dvec3 open_at{0.0}, flipped_at{0.0};  ///< the middle of the first of each [mm]
  std::optional<double> volume_mm3;  ///< negative if the triangles face inward; empty without one

  [[nodiscard]] bool inward() const noexcept { return volume_mm3 && *volume_mm3 < 0.0; }
};
/// Indices must be in range. Takes about 40 bytes for each triangle in addition to the mesh.
[[nodiscard]] MeshEnclosure enclosure_of(const TriangleMesh& mesh);

/// Estimated memory [bytes] of check_mesh in addition to a mesh of `triangles`: 50 bytes per
/// triangle were measured for one shell of 20 million. Many small, nested shells take up to twice
/// as much.
[[nodiscard]] constexpr std::uint64_t check_memory(std::size_t triangles) noexcept {
  return std::uint64_t{60} * triangles;
}

/// Reports one problem if the volume differs from the claimed one by more than its bound (plus 1e-9
/// of it for summation in double); none if the mesh agrees with its claims.
[[nodiscard]] std::vector<MeshProblem> compare_with_claims(const TriangleMesh& decoded,
                                                           const DracoClaims& claims);

}  // namespace clay::solid::inline proof
