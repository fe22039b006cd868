#include "export/repair/soup_repair.hpp"

#include "export/formats/file_floats.hpp"
#include "export/repair/crack_welding.hpp"
#include "export/repair/duplicate_triangles.hpp"
#include "export/repair/edge_splitting.hpp"
#include "export/repair/soup_edges.hpp"
#include "export/solid/disjoint_sets.hpp"
#include "export/solid/equal_points.hpp"
#include "export/solid/mesh_topology.hpp"

#include <algorithm>
#include <cmath>
#include <span>

namespace clay::solid::inline repair {
namespace {

bool finite(const glm::dvec3& p) {
  return std::isfinite(p.x) && std::isfinite(p.y) && std::isfinite(p.z);
}

/// Triangles joined by edges of two triangles, as sets named by their smallest triangle.
class Sheets {
 public:
  explicit Sheets(const TriangleMesh& mesh)
      : sets_(mesh.triangles.size()), open_(mesh.triangles.size(), false) {
    for_each_edge(mesh, [&](std::span<const SoupEdge> edges) {
      if (edges.size() == 2) sets_.unite(edges[0].triangle, edges[1].triangle);
    });
    for_each_edge(mesh, [&](std::span<const SoupEdge> edges) {
      if (edges.size() == 1) open_[of(edges[0].triangle)] = true;
    });
  }
  std::uint32_t of(std::uint32_t t) { return sets_.of(t); }
  bool open(std::uint32_t sheet) const { return open_[sheet]; }

 private:
  DisjointSets sets_;
  std::vector<bool> open_;
};

/// A fin is the only open sheet at an edge of three triangles; the other two continue the surface.
std::size_t drop_fins_once(TriangleMesh& mesh) {
  Sheets sheets(mesh);
  std::vector<bool> fin(mesh.triangles.size(), false);  // by sheet
  for_each_edge(mesh, [&](std::span<const SoupEdge> edges) {
    if (edges.size() != 3) return;
    std::array<std::uint32_t, 3> at{};
    for (std::size_t i = 0; i < 3; ++i) at[i] = sheets.of(edges[i].triangle);
    std::vector<std::uint32_t> ends_here;
    for (const std::uint32_t sheet : at)
      if (sheets.open(sheet) && std::count(at.begin(), at.end(), sheet) == 1)
        ends_here.push_back(sheet);
    if (ends_here.size() == 1) fin[ends_here.front()] = true;
  });
  std::uint32_t number = 0;
  return std::erase_if(mesh.triangles, [&](const Triangle&) { return fin[sheets.of(number++)]; });
}

void drop_fins(TriangleMesh& mesh, std::vector<Repair>& repaired) {
  // A fin may stand on another fin.
  constexpr int kMostRounds = 8;
  std::size_t dropped = 0;
  for (int round = 0; round < kMostRounds; ++round) {
    const std::size_t now = drop_fins_once(mesh);
    if (now == 0) break;
    dropped += now;
  }
  note_repair(repaired, "triangle of a fin removed", dropped);
}

}  // namespace

void note_repair(std::vector<Repair>& repaired, std::string_view what, std::size_t count) {
  if (count == 0) return;
  const auto known = std::find_if(repaired.begin(), repaired.end(),
                                  [&](const Repair& repair) { return repair.what == what; });
  if (known == repaired.end())
    repaired.push_back({std::string(what), count});
  else
    known->count += count;
}

std::size_t drop_unusable(TriangleMesh& mesh) {
  const auto no_place = [&](std::uint32_t v) {
    return v >= mesh.points.size() || !finite(mesh.points[v]);
  };
  return std::erase_if(
      mesh.triangles, [&](const Triangle& t) { return std::any_of(t.begin(), t.end(), no_place); });
}

void renumber(TriangleMesh& mesh, const std::vector<std::uint32_t>& number) {
  for (Triangle& t : mesh.triangles)
    for (std::uint32_t& v : t) v = number[v];
}

std::size_t merge_equal_points(TriangleMesh& mesh) {
  const EqualPoints equal = equal_points(mesh.points);
  renumber(mesh, equal.first);
  return equal.repeated;
}

std::size_t drop_collapsed(TriangleMesh& mesh) { return std::erase_if(mesh.triangles, collapsed); }

void clean_soup(TriangleMesh& mesh, std::optional<double> weld_mm, std::vector<Repair>& repaired) {
  note_repair(repaired, "triangle without a place removed", drop_unusable(mesh));
  round_to_file(mesh.points);
  drop_unused_points(mesh);
  note_repair(repaired, "points of one place merged", merge_equal_points(mesh));
  note_repair(repaired, "points welded across a crack", weld_cracks(mesh, weld_mm));
  note_repair(repaired, "triangle without area removed", drop_collapsed(mesh));
  note_repair(repaired, "edge split at a vertex on it", split_edges(mesh, weld_mm));
  drop_duplicates(mesh, repaired);
  drop_fins(mesh, repaired);
  drop_unused_points(mesh);
}

}  // namespace clay::solid::inline repair
