#include "export/repair/wall_samples.hpp"

#include "claystack/export/check.hpp"
#include "core/cancel.hpp"
#include "export/check/wall_ray.hpp"
#include "export/solid/box_tree.hpp"
#include "export/solid/mesh_topology.hpp"
#include "export/solid/surface_samples.hpp"

#include <algorithm>
#include <cstddef>
#include <glm/geometric.hpp>
#include <optional>
#include <vector>

namespace clay::solid::inline repair {
namespace {

/// The value that a share of the numbers is below.
double quantile(std::vector<double>& numbers, double share) {
  const auto at = numbers.begin() +
                  static_cast<std::ptrdiff_t>(share * static_cast<double>(numbers.size() - 1));
  std::ranges::nth_element(numbers, at);
  return *at;
}

}  // namespace

WallSamples sample_wall(const TriangleMesh& surface, const TriangleMesh& wall) {
  constexpr std::size_t kSamples = 4'000;
  constexpr double kLowShare = 0.03;
  const SurfaceSamples samples(surface, kSamples);
  const BoxTree tree(wall);
  std::size_t steps = most_wall_steps(2 * kSamples);
  std::vector<double> found;
  for (std::size_t i = 0; i < kSamples; ++i) {
    step_of_loop();
    const glm::dvec3 normal = glm::normalize(doubled_area(surface, samples.triangle(i)));
    const glm::dvec3 place = samples.place(i);
    const auto front = WallRay(wall, place, normal).first_hit(tree, steps);
    const auto back = WallRay(wall, place, -normal).first_hit(tree, steps);
    if (steps == 0) break;
    if (front && front->mm && back && back->mm) found.push_back(*front->mm + *back->mm);
  }
  if (found.empty()) return {};
  return {quantile(found, kLowShare), quantile(found, 0.5)};
}

}  // namespace clay::solid::inline repair
