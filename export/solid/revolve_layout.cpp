#include "export/solid/revolve_layout.hpp"

#include "core/portable_trig.hpp"
#include "export/section/stack_section.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

namespace clay::solid {
namespace {

/// Direction `s` of `n`. Reduced to an eighth of a turn in integers first, so that the polygon is
/// exactly symmetric and the directions along the axes are exact, without -0.
glm::dvec2 direction(std::size_t s, std::size_t n) {
  std::size_t eighths = 8 * s;  // unit: an eighth of a step; a full turn is 8 n
  const bool below = eighths > 4 * n;
  if (below) eighths = 8 * n - eighths;
  const bool behind = eighths > 2 * n;
  if (behind) eighths = 4 * n - eighths;
  const bool steep = eighths > n;
  if (steep) eighths = 2 * n - eighths;
  const double angle =
      std::numbers::pi / 4.0 * (static_cast<double>(eighths) / static_cast<double>(n));
  const CosSin turned = cos_sin(angle);
  // On the diagonal, which the angle misses by its rounding, both are equal.
  glm::dvec2 d = eighths == n ? glm::dvec2{std::sqrt(0.5)} : glm::dvec2{turned.cosine, turned.sine};
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

/// Programs that sum a volume in float32 about the first vertex (admesh, PrusaSlicer) drift when
/// equal terms follow each other, as they would about a pole, so the first band comes last.
Shell shell_of(const Polygon& polygon, const Chain& chain) {
  Shell shell;
  const std::size_t count = chain.edges + (chain.round ? 0 : 1);
  for (std::size_t i = 0; i < count; ++i)
    shell.points.push_back(polygon[(chain.first + i) % polygon.size()]);
  for (std::size_t edge = 1; edge <= chain.edges; ++edge) {
    const std::size_t from = edge % chain.edges;
    shell.bands.push_back({from, (from + 1) % count});
  }
  return shell;
}

}  // namespace

std::size_t Shell::triangles_per_sector() const noexcept {
  std::size_t triangles = 0;
  for (const Band& band : bands)
    triangles += (pole(band.from) ? 0u : 1u) + (pole(band.to) ? 0u : 1u);
  return triangles;
}

RevolveLayout::RevolveLayout(const Profile& profile, std::size_t segments)
    : circle_(circle_of(segments)) {
  for (const Polygon& polygon : profile.pieces)
    for (const Chain& chain : chains_of(polygon)) shells_.push_back(shell_of(polygon, chain));
}

std::size_t RevolveLayout::triangles() const noexcept {
  std::size_t triangles = 0;
  for (const Shell& shell : shells_) triangles += shell.triangles_per_sector() * segments();
  return triangles;
}

std::size_t RevolveLayout::vertices() const noexcept {
  std::size_t vertices = 0;
  for (const Shell& shell : shells_)
    for (std::size_t i = 0; i < shell.points.size(); ++i)
      vertices += shell.pole(i) ? 1 : segments();
  return vertices;
}

double equal_area_factor(std::size_t segments) noexcept {
  const double step = 2.0 * std::numbers::pi / static_cast<double>(segments);
  return std::sqrt(step / cos_sin(step).sine);
}

double float_rounding_mm(const RevolveLayout& rule) noexcept {
  const double wider = equal_area_factor(rule.segments());
  double farthest = 0.0;
  for (const Shell& shell : rule.shells())
    for (const ProfilePoint& p : shell.points)
      farthest = std::max(farthest, length_of(wider * p.rho, p.y));
  // The products are themselves rounded to double first.
  constexpr double kDoubleRounding = 1.0 + 0x1p-20;
  return std::ldexp(farthest * kDoubleRounding, -24);
}

}  // namespace clay::solid
