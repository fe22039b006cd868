#pragma once
// Is a mesh a solid that prints? The tests know nothing of how the mesh was made.

#include "claystack/export/triangle_mesh.hpp"

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

namespace clay::solid {

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

/// About how much memory [bytes] check_mesh takes beside the mesh of so many triangles: 50 bytes a
/// triangle were measured for one shell of 20 million. Shells that are many, small and nested take
/// up to twice as much.
[[nodiscard]] constexpr std::uint64_t check_memory(std::size_t triangles) noexcept {
  return std::uint64_t{60} * triangles;
}

}  // namespace clay::solid
