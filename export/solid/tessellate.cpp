#include "claystack/export/solid.hpp"

#include "core/cancel.hpp"
#include "core/portable_trig.hpp"
#include "export/solid/revolve_layout.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>
#include <vector>

namespace clay::solid {
namespace {

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
  explicit Revolution(const RevolveLayout& rule) : rule_(rule) {
    const std::size_t triangles = rule.triangles();
    mesh_.triangles.reserve(triangles);
    // Euler: a shell of T triangles has T/2 + 2 vertices, or T/2 where it is a torus.
    mesh_.points.reserve(triangles / 2 + 2 * rule.shells().size());
    for (const Shell& shell : rule.shells()) add_shell(shell);
  }

  TriangleMesh take() { return std::move(mesh_); }

 private:
  /// Poles last, for sums in float32 (see RevolveLayout).
  void add_shell(const Shell& shell) {
    std::vector<Parallel> parallels(shell.points.size());
    for (const bool pole : {false, true})
      for (std::size_t i = 0; i < shell.points.size(); ++i)
        if (shell.pole(i) == pole) parallels[i] = add_parallel(shell.points[i]);
    for (std::size_t s = 0; s < rule_.segments(); ++s)
      for (const Band& band : shell.bands) {
        step_of_loop();
        add_patch(parallels[band.from], parallels[band.to], s);
      }
  }

  Parallel add_parallel(const ProfilePoint& p) {
    step_of_loop();
    const Parallel parallel{static_cast<std::uint32_t>(mesh_.points.size()), p.rho == 0.0};
    const std::size_t count = parallel.pole ? 1 : rule_.segments();
    for (std::size_t s = 0; s < count; ++s) mesh_.points.push_back(rule_.vertex(p, s));
    return parallel;
  }

  /// Clay lies to the left of the profile, so the direction from `a` to `b`, seen from outside, is
  /// up.
  void add_patch(const Parallel& a, const Parallel& b, std::size_t s) {
    const std::size_t next = s + 1 < rule_.segments() ? s + 1 : 0;
    if (!a.pole) mesh_.triangles.push_back({a.at(s), a.at(next), b.at(s)});
    if (!b.pole) mesh_.triangles.push_back({a.at(next), b.at(next), b.at(s)});
  }

  const RevolveLayout& rule_;
  TriangleMesh mesh_;
};

}  // namespace

std::size_t triangle_count(const Profile& profile, std::size_t segments) noexcept {
  std::size_t strips = 0;  // one triangle per segment each
  for (const Polygon& polygon : profile.pieces) {
    for (std::size_t i = 0; i < polygon.size(); ++i)
      for (const std::size_t end : {i, (i + 1) % polygon.size()})
        if (polygon[end].rho != 0.0) ++strips;
  }
  return strips * segments;
}

TriangleMesh revolve(const RevolveLayout& rule) { return Revolution(rule).take(); }

TriangleMesh revolve(const Profile& profile, std::size_t segments) {
  return revolve(RevolveLayout(profile, segments));
}

double chordal_error_mm(double radius_mm, std::size_t segments) noexcept {
  const double factor = equal_area_factor(segments);
  const double at_vertices = factor - 1.0;
  const double at_mid_edges =
      1.0 - factor * cos_sin(std::numbers::pi / static_cast<double>(segments)).cosine;
  return radius_mm * std::max(at_vertices, at_mid_edges);
}

std::size_t segments_for(double radius_mm, double tolerance_mm) noexcept {
  // The error at the vertices dominates: pi^2 / (3 n^2) of the radius to first order.
  const double estimate = std::numbers::pi * std::sqrt(radius_mm / (3.0 * tolerance_mm));
  const bool within_reach = estimate < static_cast<double>(kMaxSegments);
  std::size_t segments = within_reach ? static_cast<std::size_t>(estimate) / 4 * 4 : kMaxSegments;
  segments = std::max<std::size_t>(segments, 8);
  while (segments < kMaxSegments && chordal_error_mm(radius_mm, segments) > tolerance_mm)
    segments += 4;
  return segments;
}

}  // namespace clay::solid
