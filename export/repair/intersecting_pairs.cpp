#include "export/repair/intersecting_pairs.hpp"

#include "core/cancel.hpp"
#include "export/proof/near_pairs.hpp"
#include "export/proof/pair_test.hpp"

#include <algorithm>

namespace clay::solid::inline repair {

std::vector<TrianglePair> intersecting_pairs(const TriangleMesh& mesh, std::size_t most) {
  const PairTest test(mesh);
  std::vector<BoundingHull> bodies;
  bodies.reserve(mesh.triangles.size());
  for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t) {
    step_of_loop();
    if (test.degenerate(mesh.triangles[t])) continue;
    const auto& [a, b, c] = mesh.triangles[t];
    bodies.push_back({{mesh.points[a], mesh.points[b], mesh.points[c], mesh.points[c]},
                      0.0,
                      {kNoHub, kNoHub, kNoHub},
                      t,
                      false});
  }
  std::vector<TrianglePair> found;
  if (bodies.empty()) return found;
  NearPairs near(std::move(bodies));
  near.for_each([&](std::uint32_t i, std::uint32_t j) {
    const auto [a, b] = std::minmax(near[i].number, near[j].number);
    if (test.meet(mesh.triangles[a], mesh.triangles[b])) found.emplace_back(a, b);
    return found.size() < most;
  });
  std::sort(found.begin(), found.end());
  return found;
}

}  // namespace clay::solid::inline repair
