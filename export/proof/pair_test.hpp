#pragma once
// How two triangles of a soup lie to each other, by exact predicates (CGAL).

#include "export/solid/mesh_topology.hpp"

#include <cstdint>

namespace clay::solid::inline proof {

/// For finite points and indices in range. The mesh outlives this.
class PairTest {
 public:
  explicit PairTest(const TriangleMesh& mesh) : mesh_(mesh) {}

  /// Corners in line.
  [[nodiscard]] bool degenerate(const Triangle& triangle) const;

  /// Do they meet elsewhere than in the vertices or the edge they share? Neither is degenerate.
  /// False for two on the same three vertices.
  [[nodiscard]] bool meet(Triangle a, Triangle b) const;

  /// Where vertex q lies, seen from the half-plane that begins in the line from v to w and holds
  /// p: in it 0, within the half turn counterclockwise about v->w 1, opposite 2, beyond 3. Neither
  /// p nor q is in that line.
  [[nodiscard]] int quarter(std::uint32_t v, std::uint32_t w, std::uint32_t p,
                            std::uint32_t q) const;

 private:
  const TriangleMesh& mesh_;
};

}  // namespace clay::solid::inline proof
