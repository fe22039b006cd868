#pragma once
// Winding numbers of closed sheets by exact crossings of a ray with them. For the sources of this
// room only: it needs CGAL's headers.

#include "export/repair/exact_soup.hpp"
#include "export/solid/box_tree.hpp"

#include <array>
#include <cstdint>
#include <vector>

namespace clay::solid::inline repair {

/// A triangle that a ray crosses.
struct Crossing {
  std::uint32_t triangle = 0;
  int winding = 0;  ///< its part in the winding number of the place where the ray starts
};

class WindingRay {
 public:
  /// The mesh outlives this. It has a triangle, finite points and indices in range.
  explicit WindingRay(const TriangleMesh& mesh) : mesh_(mesh), tree_(mesh) {}

  struct Count {
    int winding = 0;    ///< of the region beside the triangle, in the direction of the axis
    bool front = true;  ///< that region lies before the triangle's front
  };
  /// The ray starts in the middle of a triangle with area, and follows the axis that its normal is
  /// nearest to. The triangle crosses no sheet of the mesh. A ray through edges or vertices is
  /// shifted sideways by an infinitesimal.
  [[nodiscard]] Count from_middle_of(const std::array<ExactPoint, 3>& triangle) const;

  /// The crossings of a ray from a point, up or down an axis. The winding numbers of any closed
  /// shells beside the point, in the direction of the ray, are the sums over their triangles:
  /// sheets through the point are not crossed.
  [[nodiscard]] std::vector<Crossing> crossings(const ExactPoint& from, int axis, bool up) const;

 private:
  [[nodiscard]] int crossing(const Triangle& triangle, const ExactPoint& from, int axis,
                             bool up) const;

  const TriangleMesh& mesh_;
  BoxTree tree_;
};

/// The axis that a vector is nearest to.
int longest_axis_of(const ExactKernel::Vector_3& v);

}  // namespace clay::solid::inline repair
