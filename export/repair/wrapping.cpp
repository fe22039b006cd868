#include "export/repair/wrapping.hpp"

#include "core/cancel.hpp"
#include "export/formats/file_floats.hpp"
#include "export/repair/surface_making.hpp"

#include <CGAL/alpha_wrap_3.h>

namespace clay::solid::inline repair {

TriangleMesh wrapped(const TriangleMesh& soup, double offset_mm, double alpha_per_offset) {
  std::vector<SurfacePoint> points;
  points.reserve(soup.points.size());
  for (const glm::dvec3& p : soup.points) points.emplace_back(p.x, p.y, p.z);
  stop_if_cancelled();
  Surface surface;
  CGAL::alpha_wrap_3(points, soup.triangles, alpha_per_offset * offset_mm, offset_mm, surface);
  TriangleMesh mesh = mesh_of(surface);
  for (glm::dvec3& p : mesh.points) p = file_point(p);
  return mesh;
}

}  // namespace clay::solid::inline repair
