#pragma once
// Winding numbers of closed sheets by exact crossings of a ray with them. For the sources of this
// room only: it needs CGAL's headers.

#include "export/repair/exact_soup.hpp"
#include "export/solid/box_tree.hpp"

#include <array>

namespace clay::solid::inline repair {

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

 private:
  [[nodiscard]] int crossing(const Triangle& triangle, const ExactPoint& from, int axis) const;

  const TriangleMesh& mesh_;
  BoxTree tree_;
};

}  // namespace clay::solid::inline repair
