#pragma once
// What the indices of a mesh say by themselves, for any soup of triangles.

#include "claystack/export/solid.hpp"

#include <array>
#include <cstddef>
#include <cstdint>
#include <initializer_list>
#include <span>
#include <vector>

namespace clay::solid {

using Triangle = std::array<std::uint32_t, 3>;

/// One kind of fault: how often, and where first.
struct Fault {
  std::size_t count = 0;
  std::vector<std::uint32_t> triangles;  ///< of the first, a handful at most
  std::vector<std::uint32_t> vertices;   ///< of the first: none, a vertex, or the ends of an edge

  [[nodiscard]] bool found() const noexcept { return count > 0; }
};

/// Counts one more; the place is kept of the first only.
void note(Fault& fault, std::initializer_list<std::uint32_t> triangles,
          std::initializer_list<std::uint32_t> vertices);

/// Triangles that name a vertex twice cover no surface: they are counted in `collapsed` and
/// left out of all the rest, as if their two equal corners had been pulled together.
struct MeshTopology {
  Fault collapsed;
  Fault duplicates;                         ///< triangles on the same three vertices as one before
  Fault open_edges;                         ///< of one triangle only
  Fault crowded_edges;                      ///< of three triangles or more
  Fault flipped_edges;                      ///< whose two triangles run along it the same way
  Fault split_vertices;                     ///< whose triangles form more than one fan
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
