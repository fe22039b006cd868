#pragma once
// Faces of more than three corners, as OBJ, OFF and PLY have them, become triangles.

#include "claystack/export/solid.hpp"

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

namespace clay::solid::inline formats {

class PolygonFaces {
 public:
  /// Appends the fan from the first corner to the triangles of the mesh. The points may follow.
  void add(std::span<const std::uint32_t> corners, TriangleMesh& mesh);

  /// Call it when all points are known. A face that its fan does not cover exactly once, such as a
  /// concave one, gets the constrained Delaunay triangulation of its corners, as seen along its
  /// normal. It has as many triangles. A face that crosses or touches itself stays a fan. `notes`
  /// may be null; it gets a line on those, and one on faces that are not flat.
  void split(TriangleMesh& mesh, std::vector<std::string>* notes) const;

 private:
  struct Fan {
    std::uint32_t first = 0;    ///< triangle
    std::uint32_t corners = 0;  ///< more than 3
  };
  std::vector<Fan> fans_;
};

}  // namespace clay::solid::inline formats
