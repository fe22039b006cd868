#include "export/repair/crack_welding.hpp"

#include "export/repair/soup_edges.hpp"
#include "export/repair/soup_repair.hpp"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <limits>
#include <map>

namespace clay::solid::inline repair {
namespace {

/// Border points in cells as wide as a crack. Only the first point of a cell is stored, so no file
/// can make the search slow.
class CrackCells {
 public:
  CrackCells(const std::vector<glm::dvec3>& points, double crack_mm)
      : points_(points), crack_mm_(crack_mm) {}

  /// An earlier point within a crack's width; otherwise this one, which is stored.
  std::uint32_t first_near(std::uint32_t vertex) {
    const Cell home = cell_of(points_[vertex]);
    for (int x = -1; x <= 1; ++x)
      for (int y = -1; y <= 1; ++y)
        for (int z = -1; z <= 1; ++z) {
          const auto found = first_.find({home[0] + x, home[1] + y, home[2] + z});
          if (found != first_.end() && near(found->second, vertex)) return found->second;
        }
    first_.emplace(home, vertex);
    return vertex;
  }

 private:
  using Cell = std::array<std::int64_t, 3>;
  Cell cell_of(const glm::dvec3& p) const {
    const auto cell = [&](double x) {
      return static_cast<std::int64_t>(std::floor(x / crack_mm_));
    };
    return {cell(p.x), cell(p.y), cell(p.z)};
  }
  bool near(std::uint32_t a, std::uint32_t b) const {
    return glm::distance(points_[a], points_[b]) <= crack_mm_;
  }

  const std::vector<glm::dvec3>& points_;
  double crack_mm_;
  std::map<Cell, std::uint32_t> first_;
};

double largest_coordinate(const TriangleMesh& mesh) {
  double largest = 0.0;
  for (const Triangle& t : mesh.triangles)
    for (const std::uint32_t v : t)
      for (int axis = 0; axis < 3; ++axis)
        largest = std::max(largest, std::abs(mesh.points[v][axis]));
  return largest;
}

}  // namespace

OpenBorder open_border(const TriangleMesh& mesh, std::optional<double> weld_mm) {
  OpenBorder border{{}, std::vector<bool>(mesh.points.size(), false)};
  border.rounding_mm = 4.0 * std::numeric_limits<float>::epsilon() * largest_coordinate(mesh);
  for_each_edge(mesh, [&](std::span<const SoupEdge> edges) {
    if (edges.size() != 1) return;
    border.edges.push_back(edges[0]);
    border.points[edges[0].low] = border.points[edges[0].high] = true;
  });
  std::vector<double> lengths_mm;  // of the edges of triangles at the border
  for (const SoupEdge& edge : border.edges) {
    const Triangle& t = mesh.triangles[edge.triangle];
    for (std::size_t c = 0; c < 3; ++c) {
      const double length = glm::distance(mesh.points[t.at(c)], mesh.points[t.at((c + 1) % 3)]);
      if (length > border.rounding_mm) lengths_mm.push_back(length);
    }
  }
  if (lengths_mm.empty()) return border;
  // The shortest edge without those of slivers: a few of them do not narrow the cracks of a large
  // mesh.
  constexpr std::ptrdiff_t kEdgesPerSliver = 50;
  const auto shortest = lengths_mm.begin() + std::ssize(lengths_mm) / kEdgesPerSliver;
  std::ranges::nth_element(lengths_mm, shortest);
  const double shortest_mm = *shortest;
  const double size_mm = glm::length(extent_of(mesh).size());
  border.crack_mm =
      std::max(border.rounding_mm, weld_mm.value_or(std::min(0.25 * shortest_mm, 1e-3 * size_mm)));
  return border;
}

std::size_t weld_cracks(TriangleMesh& mesh, std::optional<double> weld_mm) {
  const OpenBorder border = open_border(mesh, weld_mm);
  if (border.crack_mm == 0.0) return 0;
  CrackCells cells(mesh.points, border.crack_mm);
  std::vector<std::uint32_t> number(mesh.points.size());
  std::size_t welded = 0;
  for (std::uint32_t v = 0; v < mesh.points.size(); ++v) {
    number[v] = border.points[v] ? cells.first_near(v) : v;
    welded += number[v] == v ? 0 : 1;
  }
  renumber(mesh, number);
  return welded;
}

}  // namespace clay::solid::inline repair
