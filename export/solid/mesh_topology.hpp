#pragma once
// The properties of a mesh that follow from its indices alone, for any soup of triangles.

#include "claystack/export/solid.hpp"

#include <array>
#include <cstddef>
#include <cstdint>
#include <initializer_list>
#include <span>
#include <vector>

namespace clay::solid {

using Triangle = std::array<std::uint32_t, 3>;

/// Uses a vertex twice.
[[nodiscard]] inline bool collapsed(const Triangle& t) noexcept {
  return t[0] == t[1] || t[1] == t[2] || t[2] == t[0];
}

/// One kind of fault: its count and its first place.
struct Fault {
  std::size_t count = 0;
  std::vector<std::uint32_t> triangles;  ///< at the first place, at most a few
  std::vector<std::uint32_t>
      vertices;  ///< at the first place: none, a vertex, or the ends of an edge

  [[nodiscard]] bool found() const noexcept { return count > 0; }
};

/// Counts one fault; keeps only the first place.
void note(Fault& fault, std::initializer_list<std::uint32_t> triangles,
          std::initializer_list<std::uint32_t> vertices);

/// Triangles that use a vertex twice cover no surface: they are counted in `collapsed` and
/// otherwise ignored, as if their two equal corners had been merged.
struct MeshTopology {
  Fault collapsed;
  Fault duplicates;     ///< triangles on the same three vertices as an earlier one
  Fault open_edges;     ///< of one triangle only
  Fault crowded_edges;  ///< of three or more triangles
  Fault flipped_edges;  ///< edges with the same direction in both triangles
  /// Along each edge as many triangles run one way as the other: otherwise the signed volume
  /// depends on the origin of the coordinates.
  bool balanced = true;
  Fault split_vertices;                     ///< vertices with more than one fan of triangles
  std::size_t components = 0;               ///< sets of triangles joined by edges
  std::vector<std::uint32_t> component_of;  ///< by triangle, where there are several

  [[nodiscard]] bool closed() const noexcept { return !open_edges.found(); }
  [[nodiscard]] bool manifold() const noexcept {
    return !crowded_edges.found() && !split_vertices.found() && !duplicates.found();
  }
  [[nodiscard]] bool oriented() const noexcept { return !flipped_edges.found(); }
};

/// Triangles with an index beyond the points.
Fault indices_out_of_range(std::size_t points, std::span<const Triangle> triangles);

/// O(n log n) time at worst, about 40 bytes a triangle. Needs at most kMaxTriangles triangles,
/// all indices in range.
MeshTopology topology_of(std::size_t points, std::span<const Triangle> triangles);

/// Keeps the points that triangles use, in their order. Indices are in range.
void drop_unused_points(TriangleMesh& mesh);

}  // namespace clay::solid
