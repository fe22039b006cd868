#pragma once
// The relation of two triangles of a soup, by exact predicates (CGAL).

#include "export/solid/mesh_topology.hpp"

#include <cstdint>

namespace clay::solid::inline proof {

/// For finite points and indices in range. The mesh outlives this.
class PairTest {
 public:
  explicit PairTest(const TriangleMesh& mesh) : mesh_(mesh) {}

  /// True if the corners are collinear.
  [[nodiscard]] bool degenerate(const Triangle& triangle) const;

  /// True if they intersect outside the vertices or the edge they share. Neither is degenerate.
  /// False for two triangles on the same three vertices.
  [[nodiscard]] bool meet(Triangle a, Triangle b) const;

  /// The position of vertex q relative to the half-plane that is bounded by the line from v to w
  /// and contains p: 0 in it, 1 within the half turn counterclockwise about v->w, 2 opposite, 3
  /// beyond. Neither p nor q is on that line.
  [[nodiscard]] int quarter(std::uint32_t v, std::uint32_t w, std::uint32_t p,
                            std::uint32_t q) const;

 private:
  const TriangleMesh& mesh_;
};

}  // namespace clay::solid::inline proof
