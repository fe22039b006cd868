#include "engine/collapse/yield_power.hpp"

#include "core/portable_trig.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <limits>
#include <utility>

namespace clay {
namespace {

/// Weights of the point nearest to the origin in the affine hull of p[0..count): Lagrange's
/// equations by elimination with pivoting. False if the points are nearly dependent.
bool nearest_weights(const std::array<Twist, 4>& p, std::size_t count,
                     std::array<double, 4>& weights) {
  double m[5][6] = {};
  for (std::size_t i = 0; i < count; ++i) {
    for (std::size_t j = 0; j < count; ++j) m[i][j] = glm::dot(p[i], p[j]);
    m[i][count] = m[count][i] = 1.0;
  }
  m[count][count + 1] = 1.0;
  for (std::size_t k = 0; k <= count; ++k) {
    std::size_t pivot = k;
    for (std::size_t i = k + 1; i <= count; ++i)
      if (std::abs(m[i][k]) > std::abs(m[pivot][k])) pivot = i;
    if (std::abs(m[pivot][k]) < 1e-13) return false;
    std::swap(m[k], m[pivot]);
    for (std::size_t i = 0; i <= count; ++i) {
      if (i == k) continue;
      const double factor = m[i][k] / m[k][k];
      for (std::size_t j = k; j <= count + 1; ++j) m[i][j] -= factor * m[k][j];
    }
  }
  for (std::size_t i = 0; i < count; ++i) weights[i] = m[i][count + 1] / m[i][i];
  return true;
}

/// Rotates by the angle with the given cosine and sine.
glm::dvec2 turned(glm::dvec2 v, glm::dvec2 turn) noexcept {
  return {turn.x * v.x - turn.y * v.y, turn.y * v.x + turn.x * v.y};
}

/// Up to four points, and the point of their convex hull nearest to the origin.
struct Corral {
  std::array<Twist, 4> points{};
  std::size_t count = 0;
  Twist nearest{0.0};

  /// Tries every subset; keeps the points that span the nearest one.
  void reduce() {
    std::array<Twist, 4> best{};
    std::size_t best_count = 0;
    double least = std::numeric_limits<double>::infinity();
    for (unsigned subset = 1; subset < (1u << count); ++subset) {
      std::array<Twist, 4> chosen{};
      std::size_t size = 0;
      for (std::size_t i = 0; i < count; ++i)
        if (subset >> i & 1u) chosen[size++] = points[i];
      std::array<double, 4> weights{};
      if (!nearest_weights(chosen, size, weights)) continue;
      Twist point{0.0};
      double smallest = 1.0;
      for (std::size_t i = 0; i < size; ++i) {
        point += weights[i] * chosen[i];
        smallest = std::min(smallest, weights[i]);
      }
      const double length2 = glm::dot(point, point);
      if (smallest < -1e-12 || !(length2 < least)) continue;
      least = length2;
      nearest = point;
      best = chosen;
      best_count = size;
    }
    points = best;
    count = best_count;
  }
};

}  // namespace

YieldPower::YieldPower(const ClayStack& stack, std::size_t failed_ring, const FallenBody& body,
                       double weight_n, double threshold_kpa)
    : stack_(stack),
      failed_(failed_ring),
      body_(body),
      share_per_mm2_(1e-3 * threshold_kpa / weight_n),
      top_mm_(stack.ring_height_mm() * static_cast<double>(failed_ring + 1) * (1.0 + 1e-12) +
              1e-12 * body.reach_mm()) {}

bool YieldPower::in_clay(glm::dvec2 place_mm, double depth2_mm2) const noexcept {
  if (!(place_mm.y > 0.0 && place_mm.y <= top_mm_)) return false;
  const auto level = static_cast<std::size_t>(place_mm.y / stack_.ring_height_mm());
  const Ring& ring = stack_.rings()[std::min(level, failed_)];
  const double radius2 = place_mm.x * place_mm.x + depth2_mm2;
  return radius2 <= mm2_from_quanta(ring.outer2) && radius2 >= mm2_from_quanta(ring.inner2);
}

void YieldPower::place(const PlanePose& pose) {
  touches_.clear();
  const auto [c, s] = cos_sin(pose.angle_rad);
  for (const SurfaceStrip& strip : body_.surface()) {
    const double middle = pose.centre_mm.y + c * strip.height_mm;
    const double rise = std::abs(s) * strip.radius_mm;
    if (middle - rise <= top_mm_ && middle + rise > 0.0) place(strip, pose.centre_mm, {c, s});
  }
}

void YieldPower::place(const SurfaceStrip& strip, glm::dvec2 centre_mm, glm::dvec2 turn) {
  const double per_gyration = 1.0 / body_.gyration_mm();
  for (const double cosine : FallenBody::directions()) {
    const glm::dvec2 arm = turned({strip.radius_mm * cosine, strip.height_mm}, turn);
    const double depth2 = strip.radius_mm * strip.radius_mm * (1.0 - cosine * cosine);
    if (!in_clay(centre_mm + arm, depth2)) continue;
    const glm::dvec2 normal = turned({strip.outward * cosine, strip.upward}, turn);
    touches_.push_back({{normal.x, normal.y, (arm.x * normal.y - arm.y * normal.x) * per_gyration},
                        share_per_mm2_ * strip.area_mm2});
  }
}

double YieldPower::plastic(const Twist& twist) const noexcept {
  double power = 0.0;
  for (const Touch& touch : touches_)
    power += touch.share * std::max(0.0, glm::dot(touch.unit_push, twist));
  return power;
}

double YieldPower::net(const Twist& twist) const noexcept { return -twist.y - plastic(twist); }

/// The load, of all sums of the weight and admissible pressures, that supports a motion least: its
/// product with the twist is the net power of the twist.
Twist YieldPower::support(const Twist& direction) const noexcept {
  Twist load{0.0, -1.0, 0.0};
  for (const Touch& touch : touches_)
    if (glm::dot(touch.unit_push, direction) > 0.0) load -= touch.share * touch.unit_push;
  return load;
}

/// The result is the smallest load (duality), found by Wolfe's algorithm. If that converges slowly,
/// the best twist so far is used.
Twist YieldPower::steepest() const noexcept {
  constexpr int kIterations = 200;
  constexpr double kNearly = 1.0 - 1e-9;
  Corral corral;
  corral.nearest = {0.0, -1.0, 0.0};
  Twist best{0.0};
  double most = kRest;
  for (int k = 0; k < kIterations; ++k) {
    const Twist u = corral.nearest;
    const double length = glm::length(u);
    if (length <= kRest) return Twist{0.0};
    const Twist load = support(u);
    const double won = glm::dot(load, u) / length;
    if (won > most) {
      most = won;
      best = u;
    }
    if (won >= kNearly * length || corral.count == 4) break;
    corral.points[corral.count++] = load;
    corral.reduce();
  }
  return best;
}

}  // namespace clay
