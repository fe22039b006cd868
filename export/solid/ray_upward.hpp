#pragma once
// What lies right above the top of a shell, by exact predicates (CGAL).

#include "export/solid/box_tree.hpp"

#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>

namespace clay::solid {

/// A ray along +z from a vertex, moved by nothing at all toward +x, and by less than that toward
/// +y: so it passes through no vertex and no edge, and along no triangle, whatever the mesh.
///
/// No triangle that is asked after touches the vertex, and none crosses another.
class RayUpward {
 public:
  struct Hit {
    std::uint32_t triangle = 0;
    bool from_back = false;  ///< the ray comes out at the triangle's front
  };

  /// The mesh outlives this.
  RayUpward(const TriangleMesh& mesh, std::uint32_t from) : mesh_(mesh), from_(mesh.points[from]) {}

  /// The lowest triangle above, of those not passed over.
  std::optional<Hit> first_hit(const BoxTree& tree,
                               const std::function<bool(std::uint32_t)>& passed_over);

  /// Boxes and triangles looked at.
  [[nodiscard]] std::size_t steps() const noexcept { return steps_; }

 private:
  [[nodiscard]] double enter(const BoxTree::Box& box) const;
  [[nodiscard]] int side(const glm::dvec3& a, const glm::dvec3& b) const;
  [[nodiscard]] std::optional<Hit> meet(std::uint32_t triangle) const;

  const TriangleMesh& mesh_;
  glm::dvec3 from_;
  std::size_t steps_ = 0;
};

}  // namespace clay::solid
