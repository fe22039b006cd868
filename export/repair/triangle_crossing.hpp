#pragma once
// The common points of two triangles, named by vertices, edges and planes: by exact predicates, and
// without constructing a point.

#include "export/solid/mesh_topology.hpp"

#include <array>
#include <cstdint>

namespace clay::solid::inline repair {

inline constexpr std::uint32_t kNoPart = UINT32_MAX;

/// A vertex; a point of an edge and a plane; or a point of two edges. Equal names are equal points,
/// but a point may have several names.
struct CrossingPoint {
  std::array<std::uint32_t, 4> name{kNoPart, kNoPart, kNoPart, kNoPart};
  /// Unless it is a vertex: the point is that of this edge in the plane of this triangle.
  std::uint32_t from = kNoPart, to = kNoPart, triangle = kNoPart;

  [[nodiscard]] bool is_vertex() const { return from == kNoPart; }
};

/// Nothing, a point, or a segment between two points.
struct Common {
  std::size_t points = 0;
  std::array<CrossingPoint, 2> ends;
};

/// For triangles with area that do not lie in one plane, on points of which no two are equal.
/// `plane_of_*`: any number that only triangles of the same plane share.
Common common_of(const TriangleMesh& mesh, std::uint32_t first, std::uint32_t second,
                 std::uint32_t plane_of_first, std::uint32_t plane_of_second);

}  // namespace clay::solid::inline repair
