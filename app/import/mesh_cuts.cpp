#include "app/import/mesh_cuts.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <glm/geometric.hpp>
#include <numbers>
#include <utility>

namespace clay::importing {
namespace {

constexpr double kStep = 2.0 * std::numbers::pi / static_cast<double>(kMeshCuts);
constexpr double kFirst = 0.381966;        // of a step
constexpr std::size_t kMostSurfaces = 64;  // at one height of a cut

/// Half-planes by number, which may lie beyond the first or last.
struct CutRange {
  long first = 0, last = -1;
};

std::size_t cut_numbered(long number) {
  constexpr auto kCount = static_cast<long>(kMeshCuts);
  return static_cast<std::size_t>(((number % kCount) + kCount) % kCount);
}

/// The half-planes that may meet a triangle or an edge.
CutRange cuts_at(std::span<const glm::dvec3> p) {
  const double start = std::atan2(p[0].y, p[0].x);
  double low = 0.0, high = 0.0;
  for (const glm::dvec3& corner : p.subspan(1)) {
    const double turn =
        std::remainder(std::atan2(corner.y, corner.x) - start, 2.0 * std::numbers::pi);
    low = std::min(low, turn);
    high = std::max(high, turn);
  }
  // Around the axis, every half-plane may meet it.
  if (high - low > 0.99 * std::numbers::pi) return {0, static_cast<long>(kMeshCuts) - 1};
  return {std::lround(std::ceil((start + low) / kStep - kFirst - 1e-9)),
          std::lround(std::floor((start + high) / kStep - kFirst + 1e-9))};
}

/// The place of the part `share` of the way along an edge, in the half-plane.
glm::dvec2 place_on(const glm::dvec3& from, const glm::dvec3& to, double share, double c, double s,
                    Edges edges) {
  const glm::dvec3 at = from + (to - from) * share;
  const double along = at.x * c + at.y * s;
  if (edges == Edges::straight || along <= 0.0) return {along, at.z};
  const double start = std::hypot(from.x, from.y);
  return {start + (std::hypot(to.x, to.y) - start) * share, at.z};
}

/// The segment of a triangle in the half-plane; empty (from = to) if there is none.
Segment cut_of(const std::array<glm::dvec3, 3>& p, std::size_t cut, Edges edges) {
  const double azimuth = azimuth_of_cut(cut), c = std::cos(azimuth), s = std::sin(azimuth);
  std::array<double, 3> side{};
  for (std::size_t i = 0; i < 3; ++i) side[i] = p[i].y * c - p[i].x * s;
  std::array<glm::dvec2, 3> ends{};
  std::size_t count = 0;
  for (std::size_t i = 0; i < 3 && count < 2; ++i) {
    const std::size_t k = (i + 1) % 3;
    if ((side[i] < 0.0) == (side[k] < 0.0)) continue;
    ends[count++] = place_on(p[i], p[k], side[i] / (side[i] - side[k]), c, s, edges);
  }
  if (count < 2 || (ends[0].x <= 0.0 && ends[1].x <= 0.0)) return {};
  // The part on this side of the axis.
  for (const auto& [a, b] : {std::pair{0, 1}, {1, 0}}) {
    glm::dvec2 &near = ends[static_cast<std::size_t>(a)], far = ends[static_cast<std::size_t>(b)];
    if (near.x < 0.0) near = near + (far - near) * (near.x / (near.x - far.x));
  }
  return {ends[0], ends[1]};
}

/// The clay of the largest area between the surfaces of one height.
Wall largest_wall(std::vector<double>& radii) {
  if (radii.size() > kMostSurfaces) return {};
  // An odd number: there is clay at the axis.
  if (radii.size() % 2 == 1) radii.push_back(0.0);
  std::sort(radii.begin(), radii.end());
  Wall largest;
  double area = 0.0;
  for (std::size_t i = 0; i < radii.size(); i += 2) {
    const double own = radii[i + 1] * radii[i + 1] - radii[i] * radii[i];
    largest.all_mm2 += own;
    if (own <= area) continue;
    area = own;
    largest.inner_mm = radii[i];
    largest.outer_mm = radii[i + 1];
  }
  return largest;
}

using Edge = std::pair<std::uint32_t, std::uint32_t>;

/// The edges of an odd number of triangles.
std::vector<Edge> odd_edges(const solid::TriangleMesh& mesh) {
  std::vector<Edge> all;
  all.reserve(3 * mesh.triangles.size());
  for (const auto& t : mesh.triangles)
    for (std::size_t i = 0; i < 3; ++i) all.emplace_back(std::minmax({t[i], t[(i + 1) % 3]}));
  std::sort(all.begin(), all.end());
  std::vector<Edge> open;
  for (auto first = all.begin(); first != all.end();) {
    const auto end = std::find_if(first, all.end(), [&](const Edge& e) { return e != *first; });
    if ((end - first) % 2 == 1) open.push_back(*first);
    first = end;
  }
  return open;
}

/// Whether each end has another one within 0.05 mm, such as where a long edge meets two edges that
/// are its halves. Sorts the ends.
bool all_paired(std::vector<glm::dvec2>& ends) {
  constexpr double kNearMm = 0.05;
  std::sort(ends.begin(), ends.end(),
            [](const glm::dvec2& a, const glm::dvec2& b) { return a.y < b.y; });
  for (std::size_t i = 0; i < ends.size(); ++i) {
    bool paired = false;
    for (std::size_t k = i; k-- > 0 && ends[i].y - ends[k].y <= kNearMm && !paired;)
      paired = glm::length(ends[i] - ends[k]) <= kNearMm;
    for (std::size_t k = i + 1; k < ends.size() && ends[k].y - ends[i].y <= kNearMm && !paired; ++k)
      paired = glm::length(ends[i] - ends[k]) <= kNearMm;
    if (!paired) return false;
  }
  return true;
}

}  // namespace

double azimuth_of_cut(std::size_t cut) noexcept {
  return kStep * (static_cast<double>(cut) + kFirst);
}

std::vector<std::vector<Segment>> mesh_cuts(const solid::TriangleMesh& mesh,
                                            std::span<const glm::dvec3> points, Edges edges) {
  std::vector<std::vector<Segment>> cuts(kMeshCuts);
  std::size_t count = 0;
  for (const auto& triangle : mesh.triangles) {
    if (count >= kMostCutSegments) break;
    std::array<glm::dvec3, 3> p{};
    for (std::size_t i = 0; i < 3; ++i) p[i] = points[triangle[i]];
    const CutRange range = cuts_at(p);
    for (long i = range.first; i <= range.last; ++i) {
      const std::size_t cut = cut_numbered(i);
      const Segment segment = cut_of(p, cut, edges);
      if (segment.from == segment.to) continue;
      cuts[cut].push_back(segment);
      ++count;
    }
  }
  return cuts;
}

std::vector<bool> complete_cuts(const solid::TriangleMesh& mesh,
                                std::span<const glm::dvec3> points) {
  std::vector<std::vector<glm::dvec2>> ends(kMeshCuts);
  for (const auto& [a, b] : odd_edges(mesh)) {
    const std::array<glm::dvec3, 2> edge{points[a], points[b]};
    const CutRange range = cuts_at(edge);
    for (long i = range.first; i <= range.last; ++i) {
      const std::size_t cut = cut_numbered(i);
      const double azimuth = azimuth_of_cut(cut), c = std::cos(azimuth), s = std::sin(azimuth);
      const double from = edge[0].y * c - edge[0].x * s, to = edge[1].y * c - edge[1].x * s;
      if ((from < 0.0) == (to < 0.0)) continue;
      const glm::dvec2 at = place_on(edge[0], edge[1], from / (from - to), c, s, Edges::straight);
      if (at.x > 0.0) ends[cut].push_back(at);
    }
  }
  std::vector<bool> complete;
  for (std::vector<glm::dvec2>& cut : ends) complete.push_back(all_paired(cut));
  return complete;
}

std::vector<Wall> walls_of(const std::vector<Segment>& cut, std::span<const double> heights_mm) {
  std::vector<std::vector<double>> rows(heights_mm.size());
  for (const Segment& s : cut) {
    const auto [low, high] = std::minmax(s.from.y, s.to.y);
    auto at = std::lower_bound(heights_mm.begin(), heights_mm.end(), low);
    for (; at != heights_mm.end() && *at < high; ++at) {
      std::vector<double>& row = rows[static_cast<std::size_t>(at - heights_mm.begin())];
      if (row.size() <= kMostSurfaces)
        row.push_back(s.from.x + (s.to.x - s.from.x) * ((*at - s.from.y) / (s.to.y - s.from.y)));
    }
  }
  std::vector<Wall> walls;
  for (std::vector<double>& row : rows) walls.push_back(largest_wall(row));
  return walls;
}

}  // namespace clay::importing
