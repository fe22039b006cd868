#include "claystack/export/tessellate.hpp"

#include "stack_section.hpp"

#include <algorithm>
#include <cmath>
#include <glm/vec2.hpp>
#include <numbers>
#include <utility>
#include <vector>

namespace clay::solid {
namespace {

double equal_area_factor(std::size_t segments) {
  const double step = 2.0 * std::numbers::pi / static_cast<double>(segments);
  return std::sqrt(step / std::sin(step));
}

/// Direction `s` of `n`. Folded into an eighth of a turn by integers first, so that the polygon
/// is symmetric to the last bit and the directions along the axes are exact, without a -0.
glm::dvec2 direction(std::size_t s, std::size_t n) {
  std::size_t eighths = 8 * s;  // of a step: a full turn is 8 n of them
  const bool below = eighths > 4 * n;
  if (below) eighths = 8 * n - eighths;
  const bool behind = eighths > 2 * n;
  if (behind) eighths = 4 * n - eighths;
  const bool steep = eighths > n;
  if (steep) eighths = 2 * n - eighths;
  const double angle =
      std::numbers::pi / 4.0 * (static_cast<double>(eighths) / static_cast<double>(n));
  // On the diagonal the sine and cosine of the library may differ by an ulp.
  glm::dvec2 d =
      eighths == n ? glm::dvec2{std::sqrt(0.5)} : glm::dvec2{std::cos(angle), std::sin(angle)};
  if (steep) std::swap(d.x, d.y);
  if (behind) d.x = -d.x;
  if (below) d.y = -d.y;
  return d;
}

std::vector<glm::dvec2> circle_of(std::size_t segments) {
  const double factor = equal_area_factor(segments);
  std::vector<glm::dvec2> circle(segments);
  for (std::size_t s = 0; s < segments; ++s) circle[s] = factor * direction(s, segments);
  return circle;
}

/// The vertices of one point of the profile: a circle of them, or one pole.
struct Parallel {
  std::uint32_t first = 0;
  bool pole = false;
  [[nodiscard]] std::uint32_t at(std::size_t s) const {
    return pole ? first : first + static_cast<std::uint32_t>(s);
  }
};

class Revolution {
 public:
  Revolution(const Profile& profile, std::size_t segments) : circle_(circle_of(segments)) {
    const std::size_t triangles = triangle_count(profile, segments);
    mesh_.triangles.reserve(triangles);
    // Euler: a shell of T triangles has T/2 + 2 vertices, or T/2 where it is a torus.
    std::size_t shells = 0;
    for (const Polygon& polygon : profile.pieces) shells += chains_of(polygon).size();
    mesh_.points.reserve(triangles / 2 + 2 * shells);
    for (const Polygon& polygon : profile.pieces)
      for (const Chain& chain : chains_of(polygon)) add_shell(polygon, chain);
  }

  TriangleMesh take() { return std::move(mesh_); }

 private:
  /// Sector by sector, and poles last. Programs that add up a volume in float32 about the first
  /// vertex (admesh, PrusaSlicer) drift where equal terms follow each other, as they would band
  /// by band or about a pole.
  void add_shell(const Polygon& polygon, const Chain& chain) {
    const std::size_t count = chain.edges + (chain.round ? 0 : 1);
    const auto point = [&](std::size_t i) { return polygon[(chain.first + i) % polygon.size()]; };
    std::vector<Parallel> parallels(count);
    for (const bool pole : {false, true})
      for (std::size_t i = 0; i < count; ++i)
        if ((point(i).rho == 0.0) == pole) parallels[i] = add_parallel(point(i));
    for (std::size_t s = 0; s < circle_.size(); ++s)
      for (std::size_t edge = 1; edge <= chain.edges; ++edge) {
        const std::size_t lower = edge % chain.edges;
        add_patch(parallels[lower], parallels[(lower + 1) % count], s);
      }
  }

  Parallel add_parallel(const ProfilePoint& p) {
    const Parallel parallel{static_cast<std::uint32_t>(mesh_.points.size()), p.rho == 0.0};
    const double height = p.y + 0.0;  // turns -0 into +0
    if (parallel.pole)
      mesh_.points.emplace_back(0.0, 0.0, height);
    else
      for (const glm::dvec2& d : circle_)
        mesh_.points.emplace_back(p.rho * d.x, p.rho * d.y, height);
    return parallel;
  }

  /// Clay lies to the left of the profile, so the way from `a` to `b`, seen from outside, is up.
  void add_patch(const Parallel& a, const Parallel& b, std::size_t s) {
    const std::size_t next = s + 1 < circle_.size() ? s + 1 : 0;
    if (!a.pole) mesh_.triangles.push_back({a.at(s), a.at(next), b.at(next)});
    if (!b.pole) mesh_.triangles.push_back({a.at(s), b.at(next), b.at(s)});
  }

  std::vector<glm::dvec2> circle_;
  TriangleMesh mesh_;
};

}  // namespace

std::size_t triangle_count(const Profile& profile, std::size_t segments) noexcept {
  std::size_t strips = 0;  // of one triangle for each segment
  for (const Polygon& polygon : profile.pieces) {
    for (std::size_t i = 0; i < polygon.size(); ++i)
      for (const std::size_t end : {i, (i + 1) % polygon.size()})
        if (polygon[end].rho != 0.0) ++strips;
  }
  return strips * segments;
}

TriangleMesh revolve(const Profile& profile, std::size_t segments) {
  return Revolution(profile, segments).take();
}

double chordal_error_mm(double radius_mm, std::size_t segments) noexcept {
  const double factor = equal_area_factor(segments);
  const double at_vertices = factor - 1.0;
  const double at_mid_edges =
      1.0 - factor * std::cos(std::numbers::pi / static_cast<double>(segments));
  return radius_mm * std::max(at_vertices, at_mid_edges);
}

std::size_t segments_for(double radius_mm, double tolerance_mm) noexcept {
  // The error at the vertices leads: pi^2 / (3 n^2) of the radius to first order.
  const double estimate = std::numbers::pi * std::sqrt(radius_mm / (3.0 * tolerance_mm));
  const bool within_reach = estimate < static_cast<double>(kMaxSegments);
  std::size_t segments = within_reach ? static_cast<std::size_t>(estimate) / 4 * 4 : kMaxSegments;
  segments = std::max<std::size_t>(segments, 8);
  while (segments < kMaxSegments && chordal_error_mm(radius_mm, segments) > tolerance_mm)
    segments += 4;
  return segments;
}

}  // namespace clay::solid
