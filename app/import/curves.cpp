#include "app/import/curves.hpp"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>

namespace clay::importing {
namespace {

// More than a curve on a page needs.
constexpr double kMostChords = 4096.0;

/// The number of chords: `parts` rounded up, from 1 to kMostChords; 1 for NaN.
int chords_in(double parts) {
  return parts > 1.0 ? static_cast<int>(std::ceil(std::min(parts, kMostChords))) : 1;
}

/// Number of equal chords if half the second derivative over a step is at most `bend_mm`: the error
/// of a chord is an eighth of |f''| times the step squared.
int chords_for(double bend_mm) { return chords_in(std::sqrt(bend_mm / (8.0 * kFlatMm))); }

glm::dvec2 projected(const glm::dvec3& p) { return glm::dvec2(p) / p.z; }

/// De Boor's algorithm in homogeneous coordinates, t within the knots of span `k`.
glm::dvec2 spline_at(std::size_t degree, std::span<const glm::dvec3> control,
                     std::span<const double> knots, std::size_t k, double t) {
  std::vector<glm::dvec3> d;
  for (std::size_t j = 0; j <= degree; ++j) {
    const glm::dvec3& p = control[j + k - degree];
    d.emplace_back(p.x * p.z, p.y * p.z, p.z);
  }
  for (std::size_t r = 1; r <= degree; ++r) {
    for (std::size_t j = degree; j >= r; --j) {
      const double low = knots[j + k - degree], high = knots[j + 1 + k - r];
      const double part = high > low ? (t - low) / (high - low) : 0.0;
      d[j] = (1.0 - part) * d[j - 1] + part * d[j];
    }
  }
  return projected(d[degree]);
}

}  // namespace

void append_cubic(std::vector<glm::dvec2>& points, glm::dvec2 a, glm::dvec2 b, glm::dvec2 c,
                  glm::dvec2 d) {
  const double bend = 6.0 * std::max(glm::length(a - 2.0 * b + c), glm::length(b - 2.0 * c + d));
  const int chords = chords_for(bend);
  for (int i = 1; i < chords; ++i) {
    const double t = static_cast<double>(i) / chords, s = 1.0 - t;
    points.push_back(s * s * s * a + 3.0 * s * s * t * b + 3.0 * s * t * t * c + t * t * t * d);
  }
  points.push_back(d);
}

void append_arc(std::vector<glm::dvec2>& points, glm::dvec2 centre, glm::dvec2 u, glm::dvec2 v,
                double from, double to) {
  const double turn = to - from;
  const int chords = std::max(chords_for(std::max(glm::length(u), glm::length(v)) * turn * turn),
                              chords_in(std::abs(turn) / (0.5 * std::numbers::pi)));
  for (int i = 1; i <= chords; ++i) {
    const double t = from + turn * static_cast<double>(i) / chords;
    points.push_back(centre + std::cos(t) * u + std::sin(t) * v);
  }
}

BulgeArc bulge_arc(glm::dvec2 from, glm::dvec2 to, double bulge) {
  const glm::dvec2 chord = to - from, left{-chord.y, chord.x};
  const glm::dvec2 centre = 0.5 * (from + to) + left * ((1.0 - bulge * bulge) / (4.0 * bulge));
  const glm::dvec2 u = from - centre;
  return {centre, u, {-u.y, u.x}, 4.0 * std::atan(bulge)};
}

std::vector<glm::dvec2> spline_points(std::size_t degree, std::span<const glm::dvec3> control,
                                      std::span<const double> knots) {
  double bend = 0.0;
  for (std::size_t i = 2; i < control.size(); ++i)
    bend =
        std::max(bend, glm::length(glm::dvec2(control[i - 2] - 2.0 * control[i - 1] + control[i])));
  // The control polygon bends at least as much as the curve, and weights may contract it.
  const auto n = static_cast<double>(degree);
  // The limit matters only where the curve has more points than a drawing may have.
  const int chords =
      std::min(chords_for(4.0 * n * n * bend), static_cast<int>(kMostPoints / control.size()) + 1);
  std::vector<glm::dvec2> points;
  for (std::size_t k = degree; k < control.size(); ++k) {
    if (!(knots[k + 1] > knots[k])) continue;
    for (int i = points.empty() ? 0 : 1; i <= chords; ++i) {
      const double t = knots[k] + (knots[k + 1] - knots[k]) * static_cast<double>(i) / chords;
      points.push_back(spline_at(degree, control, knots, k, t));
    }
  }
  return points;
}

}  // namespace clay::importing
