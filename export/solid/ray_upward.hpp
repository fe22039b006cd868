#pragma once
// Finds the triangle directly above the top of a shell, by exact predicates (CGAL).

#include "export/solid/box_tree.hpp"

#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>

namespace clay::solid {

/// A ray along +z from a vertex, symbolically perturbed toward +x and, by a smaller order, toward
/// +y: it passes through no vertex or edge and along no triangle of any mesh.
///
/// Requires that no queried triangle touches the vertex, and for the first hit that none intersect.
class RayUpward {
 public:
  struct Hit {
    std::uint32_t triangle = 0;
    bool from_back = false;  ///< the ray leaves through the triangle's front
  };

  /// The mesh outlives this.
  RayUpward(const TriangleMesh& mesh, std::uint32_t from) : mesh_(mesh), from_(mesh.points[from]) {}

  /// The lowest triangle above, of those not skipped.
  std::optional<Hit> first_hit(const BoxTree& tree,
                               const std::function<bool(std::uint32_t)>& passed_over);

  /// For triangles that may intersect: some triangle of the surface whose front the ray leaves
  /// more often than it enters it, so that the vertex lies in its clay; else empty.
  std::optional<Hit> enclosing_hit(const BoxTree& tree,
                                   const std::function<bool(std::uint32_t)>& passed_over);

  /// Number of visited boxes and triangles.
  [[nodiscard]] std::size_t steps() const noexcept { return steps_; }

 private:
  /// Calls `use(hit)` for the triangles above, nearer boxes first; boxes beyond `limit` (a height
  /// [mm], which `use` may lower) are left out.
  template <class Use>
  void for_each_hit(const BoxTree& tree, const std::function<bool(std::uint32_t)>& passed_over,
                    const double& limit, const Use& use);
  [[nodiscard]] double enter(const BoxTree::Box& box) const;
  [[nodiscard]] int side(const glm::dvec3& a, const glm::dvec3& b) const;
  [[nodiscard]] std::optional<Hit> meet(std::uint32_t triangle) const;

  const TriangleMesh& mesh_;
  glm::dvec3 from_;
  std::size_t steps_ = 0;
};

}  // namespace clay::solid
