#include "export/formats/point_merging.hpp"

#include "core/text.hpp"
#include "export/solid/equal_points.hpp"
#include "export/solid/mesh_topology.hpp"

#include <cstdint>
#include <utility>

namespace clay::solid::inline formats {
namespace {

/// A sum over the directed edges in which opposite ones cancel out: not 0 if an edge is open.
std::uint64_t unpaired_edges(const TriangleMesh& mesh) {
  const auto mixed = [](std::uint64_t edge) {  // the finalizer of SplitMix64
    edge = (edge ^ (edge >> 30)) * 0xBF58476D1CE4E5B9ULL;
    edge = (edge ^ (edge >> 27)) * 0x94D049BB133111EBULL;
    return edge ^ (edge >> 31);
  };
  std::uint64_t sum = 0;
  const auto add = [&](std::uint64_t from, std::uint64_t to) {
    if (from < to)
      sum += mixed(from << 32 | to);
    else
      sum -= mixed(to << 32 | from);
  };
  for (const auto& [a, b, c] : mesh.triangles) {
    add(a, b);
    add(b, c);
    add(c, a);
  }
  return sum;
}

std::size_t open_edges(const TriangleMesh& mesh) {
  return topology_of(mesh.points.size(), mesh.triangles).open_edges.count;
}

}  // namespace

void share_equal_points(TriangleMesh& mesh, std::vector<std::string>* notes) {
  // Most files need no more than this pass.
  if (mesh.triangles.empty() || mesh.triangles.size() > kMaxTriangles || unpaired_edges(mesh) == 0)
    return;
  const EqualPoints equal = equal_points(mesh.points);
  if (equal.repeated == 0) return;
  TriangleMesh merged;
  std::vector<std::uint32_t> number;
  number.reserve(mesh.points.size());
  for (std::uint32_t i = 0; i < mesh.points.size(); ++i) {
    const bool is_first = equal.first[i] == i;
    number.push_back(is_first ? static_cast<std::uint32_t>(merged.points.size())
                              : number[equal.first[i]]);
    if (is_first) merged.points.push_back(mesh.points[i]);
  }
  // A triangle that collapses closes no edge.
  TriangleMesh apart{mesh.points, {}};
  merged.triangles.reserve(mesh.triangles.size());
  for (const auto& [a, b, c] : mesh.triangles) {
    const auto& [i, j, k] =
        merged.triangles.emplace_back(Triangle{number[a], number[b], number[c]});
    if (i != j && j != k && k != i) apart.triangles.push_back({a, b, c});
  }
  if (open_edges(merged) >= open_edges(apart)) return;
  mesh = std::move(merged);
  if (notes != nullptr)
    notes->push_back("triangles do not share their points in the file: " +
                     counted(equal.repeated, "equal point") + " merged");
}

}  // namespace clay::solid::inline formats
