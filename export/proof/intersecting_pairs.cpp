#include "export/proof/intersecting_pairs.hpp"

#include "core/parallel_parts.hpp"
#include "export/proof/soup_intersections.hpp"

#include <algorithm>
#include <atomic>

namespace clay::solid::inline proof {

std::vector<TrianglePair> intersecting_pairs(const TriangleMesh& mesh, std::size_t most) {
  if (mesh.triangles.empty()) return {};
  SoupIntersections search(mesh);
  std::atomic<std::size_t> count{0};
  std::vector<std::vector<TrianglePair>> found(search.parts());
  for_each_part(search.parts(), [&](std::size_t part) {
    CrossingList list(count, most);
    if (list.full()) return;
    search.search(part, list);
    found[part] = std::move(list.found);
  });
  std::vector<TrianglePair> all;
  for (const auto& of_part : found) all.insert(all.end(), of_part.begin(), of_part.end());
  std::sort(all.begin(), all.end());
  all.resize(std::min(all.size(), most));
  return all;
}

}  // namespace clay::solid::inline proof
