#include "export/repair/wrapping.hpp"

#include "core/cancel.hpp"
#include "export/formats/file_floats.hpp"
#include "export/repair/surface_making.hpp"

#include <CGAL/alpha_wrap_3.h>
#include <cmath>
#include <glm/geometric.hpp>

namespace clay::solid::inline repair {

TriangleMesh wrapped(const TriangleMesh& soup, double offset_mm, double alpha_mm) {
  std::vector<SurfacePoint> points;
  points.reserve(soup.points.size());
  for (const glm::dvec3& p : soup.points) points.emplace_back(p.x, p.y, p.z);
  stop_if_cancelled();
  Surface surface;
  CGAL::alpha_wrap_3(points, soup.triangles, alpha_mm, offset_mm, surface);
  TriangleMesh mesh = mesh_of(surface);
  for (glm::dvec3& p : mesh.points) p = file_point(p);
  return mesh;
}

double area_mm2(const TriangleMesh& soup) {
  double area = 0.0;
  for (const auto& [a, b, c] : soup.triangles)
    area += 0.5 * glm::length(
                      glm::cross(soup.points[b] - soup.points[a], soup.points[c] - soup.points[a]));
  return area;
}

double least_wrap_offset_mm(const TriangleMesh& soup, double alpha_per_offset) {
  constexpr double kTrianglesPerSquare = 2.7;
  return std::sqrt(kTrianglesPerSquare * area_mm2(soup) / kMostWrapTriangles) / alpha_per_offset;
}

}  // namespace clay::solid::inline repair
