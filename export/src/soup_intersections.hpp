#pragma once
// Which triangles of a soup meet, by exact predicates (CGAL).

#include "mesh_topology.hpp"

#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

namespace clay::solid {

/// Counting stops here: a mesh in such a state is a lost one.
inline constexpr std::size_t kMaxSelfIntersections = 100'000;

/// Pairs of triangles that meet elsewhere than in the vertices or the edge they share, for any
/// soup of finite points and indices in range. Triangles with corners in line, and pairs on the
/// same three vertices, are passed over.
///
/// The search goes by slabs across the longest side of the mesh, each with the triangles that
/// reach into it: small sets stay near the processor, and several cores can share them. The
/// slabs depend on the mesh alone, so the result is the same on any machine. The lists hold at
/// most two entries a triangle, about.
class SlabIntersections {
 public:
  /// The mesh outlives this.
  explicit SlabIntersections(const TriangleMesh& mesh);

  [[nodiscard]] const Fault& degenerate() const noexcept { return degenerate_; }
  [[nodiscard]] std::size_t slabs() const noexcept { return begins_.size(); }
  void search(std::size_t slab);  ///< each once, in any order and on any thread
  /// Of the slabs searched: how many pairs, and the one of lowest numbers.
  [[nodiscard]] Fault found() const;

 private:
  using Pair = std::pair<std::uint32_t, std::uint32_t>;
  struct Crossings {
    std::size_t count = 0;
    Pair first{UINT32_MAX, UINT32_MAX};
  };

  void set_degenerate_aside();
  void choose_begins();
  bool distribute();
  void halve_slabs();
  [[nodiscard]] std::pair<double, double> reach(const Triangle& triangle) const;
  [[nodiscard]] std::size_t slab_of(double low) const;

  const TriangleMesh& mesh_;
  int axis_;
  std::vector<double> begins_;                       ///< of the slabs along the axis, rising
  std::vector<std::uint32_t> spread_;                ///< triangles that are not degenerate
  std::vector<std::vector<std::uint32_t>> members_;  ///< of the slabs, triangles
  std::vector<Crossings> found_;
  Fault degenerate_;
};

}  // namespace clay::solid
