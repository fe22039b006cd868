#include "export/repair/wall_gaps.hpp"

#include "core/cancel.hpp"
#include "export/repair/winding_ray.hpp"
#include "export/solid/surface_samples.hpp"

#include <glm/geometric.hpp>

namespace clay::solid::inline repair {

double share_filled(const TriangleMesh& surface, const TriangleMesh& wall, double offset_mm) {
  constexpr std::size_t kSamples = 1'000;  // on each side
  constexpr double kBeyond = 1.3;
  const SurfaceSamples samples(surface, kSamples);
  const WindingRay ray(wall);
  std::size_t inside = 0;
  for (std::size_t i = 0; i < kSamples; ++i) {
    stop_if_cancelled();
    const glm::dvec3 normal = glm::normalize(doubled_area(surface, samples.triangle(i)));
    const glm::dvec3 place = samples.place(i);
    for (const double side : {1.0, -1.0}) {
      const glm::dvec3 beside = place + side * kBeyond * offset_mm * normal;
      int winding = 0;
      for (const Crossing& crossed : ray.crossings(exact_point(beside), 2, true))
        winding += crossed.winding;
      if (winding > 0) ++inside;
    }
  }
  return static_cast<double>(inside) / (2.0 * kSamples);
}

}  // namespace clay::solid::inline repair
