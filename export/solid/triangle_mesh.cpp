#include "claystack/export/solid.hpp"

#include "core/compensated_sum.hpp"
#include "export/solid/bounded_volume.hpp"

#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <limits>

namespace clay::solid {
namespace {

/// The determinant of three edges with every sign positive: any rounding error is at most a few
/// units of that (Shewchuk, "Adaptive precision floating-point arithmetic", section 4.3).
double cross_sizes(const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& c) {
  const glm::dvec3 p = glm::abs(a), q = glm::abs(b), r = glm::abs(c);
  return p.x * (q.y * r.z + q.z * r.y) + p.y * (q.z * r.x + q.x * r.z) +
         p.z * (q.x * r.y + q.y * r.x);
}

}  // namespace

MeshExtent extent_of(const TriangleMesh& mesh) noexcept {
  if (mesh.triangles.empty()) return {};
  const glm::dvec3 first = mesh.points[mesh.triangles.front().front()];
  MeshExtent extent{first, first};
  for (const auto& triangle : mesh.triangles)
    for (const std::uint32_t v : triangle) {
      extent.low = glm::min(extent.low, mesh.points[v]);
      extent.high = glm::max(extent.high, mesh.points[v]);
    }
  return extent;
}

SignedVolume bounded_volume(const TriangleMesh& mesh) noexcept {
  if (mesh.points.empty()) return {};
  const glm::dvec3 origin = mesh.points.front();
  CompensatedSum sextuple;
  double sizes = 0.0;
  for (const auto& [a, b, c] : mesh.triangles) {
    const glm::dvec3 p = mesh.points[a] - origin, q = mesh.points[b] - origin,
                     r = mesh.points[c] - origin;
    sextuple.add(glm::dot(p, glm::cross(q, r)));
    sizes += cross_sizes(p, q, r);
  }
  // A term takes three differences, two products of two and three sums: each factor and step has an
  // error of at most half an epsilon, and the compensated sum one or two of the total.
  constexpr double kRoundings = 16.0;
  constexpr double kEpsilon = std::numeric_limits<double>::epsilon();
  const double underflow =
      16.0 * static_cast<double>(mesh.triangles.size()) * std::numeric_limits<double>::min();
  return {sextuple.value() / 6.0, (kRoundings * kEpsilon * sizes + underflow) / 6.0};
}

double signed_volume(const TriangleMesh& mesh) noexcept { return bounded_volume(mesh).mm3; }

}  // namespace clay::solid
