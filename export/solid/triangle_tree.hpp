#pragma once
// CGAL's tree of boxes over the triangles of a mesh. Requires CGAL's headers: do not include this
// in other headers.

#include "claystack/export/solid.hpp"
#include "export/solid/cgal_versions.hpp"

#include <CGAL/AABB_tree.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <glm/geometric.hpp>
#include <vector>

namespace clay::solid {

/// Triangles without area are left out. Requires finite points and indices in range.
class TriangleTree {
 public:
  using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
  using Triangles = std::vector<Kernel::Triangle_3>;
  using Primitive = cgal::TrianglePrimitive<Kernel, Triangles::const_iterator>;
  using Tree = CGAL::AABB_tree<cgal::BoxTraits<Kernel, Primitive>>;

  static Kernel::Point_3 point(const glm::dvec3& p) { return {p.x, p.y, p.z}; }

  explicit TriangleTree(const TriangleMesh& mesh) {
    triangles_.reserve(mesh.triangles.size());
    for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t) {
      const auto& [a, b, c] = mesh.triangles[t];
      const Kernel::Triangle_3 triangle(point(mesh.points[a]), point(mesh.points[b]),
                                        point(mesh.points[c]));
      if (triangle.is_degenerate()) continue;
      triangles_.push_back(triangle);
      numbers_.push_back(t);
    }
    tree_.insert(triangles_.cbegin(), triangles_.cend());
    tree_.build();
  }
  TriangleTree(const TriangleTree&) = delete;
  TriangleTree& operator=(const TriangleTree&) = delete;

  [[nodiscard]] bool empty() const { return triangles_.empty(); }
  /// Allows queries from many threads.
  [[nodiscard]] const Tree& boxes() const { return tree_; }
  /// Prepares nearest-point queries; call before the first one.
  void prepare_distances() { tree_.accelerate_distance_queries(); }
  /// The triangle's number in the mesh.
  [[nodiscard]] std::uint32_t number(Triangles::const_iterator triangle) const {
    return numbers_[static_cast<std::size_t>(triangle - triangles_.cbegin())];
  }

 private:
  Triangles triangles_;
  std::vector<std::uint32_t> numbers_;
  Tree tree_;
};

}  // namespace clay::solid
