#pragma once
// The edges of a soup, each with all its triangles.

#include "core/cancel.hpp"
#include "export/solid/mesh_topology.hpp"

#include <algorithm>
#include <span>
#include <vector>

namespace clay::solid::inline repair {

struct SoupEdge {
  std::uint32_t low, high, triangle;
  friend auto operator<=>(const SoupEdge&, const SoupEdge&) = default;
  [[nodiscard]] bool same_place(const SoupEdge& other) const {
    return low == other.low && high == other.high;
  }
};

/// 1 if the triangle follows the edge from its low vertex to its high one, otherwise -1.
inline int direction(const TriangleMesh& mesh, const SoupEdge& edge) {
  const Triangle& t = mesh.triangles[edge.triangle];
  for (std::size_t c = 0; c < 3; ++c)
    if (t.at(c) == edge.low) return t.at((c + 1) % 3) == edge.high ? 1 : -1;
  return 0;  // no edge of the triangle
}

/// Calls visit(edges) for each edge of the mesh: one entry per triangle, in ascending order.
template <class Visit>
void for_each_edge(const TriangleMesh& mesh, const Visit& visit) {
  std::vector<SoupEdge> all;
  all.reserve(3 * mesh.triangles.size());
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    if (collapsed(mesh.triangles[t])) continue;
    for (std::size_t c = 0; c < 3; ++c) {
      const auto [low, high] = std::minmax(mesh.triangles[t][c], mesh.triangles[t][(c + 1) % 3]);
      all.push_back({low, high, static_cast<std::uint32_t>(t)});
    }
  }
  std::sort(all.begin(), all.end());
  for (auto begin = all.begin(); begin != all.end();) {
    const auto end = std::find_if(begin, all.end(),
                                  [&](const SoupEdge& edge) { return !edge.same_place(*begin); });
    visit(std::span<const SoupEdge>(begin, end));
    begin = end;
  }
}

}  // namespace clay::solid::inline repair
