#pragma once
// Finds intersecting triangles of a soup, by exact predicates (CGAL).

#include "export/proof/crossings.hpp"
#include "export/proof/fan_intersections.hpp"
#include "export/solid/mesh_topology.hpp"

#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

namespace clay::solid::inline proof {

/// Pairs of triangles that intersect outside the vertices or the edge they share, for any soup of
/// finite points and indices in range. Degenerate triangles, and pairs on the same three vertices,
/// are skipped.
///
/// The search is split into parts for several cores. Vertices and edges of many triangles have
/// their own parts; all other pairs are split into slabs across the longest side of the mesh, each
/// with the triangles that reach into it: small sets stay in the cache. The parts depend on the
/// mesh alone, so the result is the same on any machine. The slabs' lists hold at most about two
/// entries per triangle.
class SoupIntersections {
 public:
  /// The mesh outlives this.
  explicit SoupIntersections(const TriangleMesh& mesh);

  [[nodiscard]] const Fault& degenerate() const noexcept { return degenerate_; }
  [[nodiscard]] std::size_t slabs() const noexcept { return begins_.size(); }
  [[nodiscard]] std::size_t parts() const noexcept { return found_.size(); }
  /// Searches each part once, in any order and on any thread.
  void search(std::size_t part);
  /// The same, for the pairs themselves.
  void search(std::size_t part, PairSink& sink);
  /// Of the parts searched without a sink: the number of pairs, and the pair of lowest numbers.
  [[nodiscard]] Fault found() const;

 private:
  void set_degenerate_aside();
  void group_hubs();
  void choose_begins();
  bool distribute();
  void halve_slabs();
  void search_hubs(std::size_t group, PairSink& sink) const;
  void search_slab(std::size_t slab, PairSink& sink);
  [[nodiscard]] std::pair<double, double> reach(const Triangle& triangle) const;
  [[nodiscard]] std::size_t slab_of(double low) const;

  const TriangleMesh& mesh_;
  int axis_;
  std::vector<double> begins_;         ///< starts of the slabs along the axis, ascending
  std::vector<std::uint32_t> spread_;  ///< triangles that are not degenerate
  std::vector<std::vector<std::uint32_t>> members_;  ///< triangles by slab
  HighValenceVertices hubs_;
  std::vector<std::size_t> groups_;  ///< hubs by group: the first of each, and the end of the last
  std::vector<Crossings> found_;     ///< by part: groups of hubs, then slabs
  Fault degenerate_;
};

}  // namespace clay::solid::inline proof
