#include "app/import/mesh_cuts.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

namespace clay::importing {
namespace {

constexpr double kStep = 2.0 * std::numbers::pi / static_cast<double>(kMeshCuts);
constexpr double kFirst = 0.381966;        // of a step
constexpr std::size_t kMostSurfaces = 64;  // at one height of a cut

/// The segment of a triangle in the half-plane; empty (from = to) if there is none.
Segment cut_of(const std::array<glm::dvec3, 3>& p, std::size_t cut) {
  const double azimuth = azimuth_of_cut(cut), c = std::cos(azimuth), s = std::sin(azimuth);
  std::array<double, 3> side{};
  for (std::size_t i = 0; i < 3; ++i) side[i] = p[i].y * c - p[i].x * s;
  std::array<glm::dvec2, 3> ends{};
  std::size_t count = 0;
  for (std::size_t i = 0; i < 3 && count < 2; ++i) {
    const std::size_t k = (i + 1) % 3;
    if ((side[i] < 0.0) == (side[k] < 0.0)) continue;
    const glm::dvec3 at = p[i] + (p[k] - p[i]) * (side[i] / (side[i] - side[k]));
    ends[count++] = {at.x * c + at.y * s, at.z};
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

}  // namespace

double azimuth_of_cut(std::size_t cut) noexcept {
  return kStep * (static_cast<double>(cut) + kFirst);
}

std::vector<std::vector<Segment>> mesh_cuts(const solid::TriangleMesh& mesh,
                                            std::span<const glm::dvec3> points) {
  std::vector<std::vector<Segment>> cuts(kMeshCuts);
  constexpr auto kCount = static_cast<long>(kMeshCuts);
  std::size_t count = 0;
  for (const auto& triangle : mesh.triangles) {
    if (count >= kMostCutSegments) break;
    std::array<glm::dvec3, 3> p{};
    for (std::size_t i = 0; i < 3; ++i) p[i] = points[triangle[i]];
    const double start = std::atan2(p[0].y, p[0].x);
    double low = 0.0, high = 0.0;
    for (std::size_t i = 1; i < 3; ++i) {
      const double turn =
          std::remainder(std::atan2(p[i].y, p[i].x) - start, 2.0 * std::numbers::pi);
      low = std::min(low, turn);
      high = std::max(high, turn);
    }
    // Around the axis, every half-plane may meet the triangle.
    const bool around = high - low > 0.99 * std::numbers::pi;
    const long first = around ? 0 : std::lround(std::ceil((start + low) / kStep - kFirst - 1e-9));
    const long last =
        around ? kCount - 1 : std::lround(std::floor((start + high) / kStep - kFirst + 1e-9));
    for (long i = first; i <= last; ++i) {
      const auto cut = static_cast<std::size_t>(((i % kCount) + kCount) % kCount);
      const Segment segment = cut_of(p, cut);
      if (segment.from == segment.to) continue;
      cuts[cut].push_back(segment);
      ++count;
    }
  }
  return cuts;
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
