#pragma once
// An independent analysis of a collapse in space, ring by ring: positions of points and the power
// of motions. It takes only the resting position from the engine.

#include "claystack/engine/collapse.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <glm/geometric.hpp>
#include <glm/gtc/quaternion.hpp>
#include <numbers>
#include <utility>
#include <vector>

namespace clay::falls {

constexpr double kPi = std::numbers::pi;

inline Pot pot_of(ClayStack stack, double density_g_cm3 = 1.9) {
  Pot pot;
  pot.stack = std::move(stack);
  pot.density_g_cm3 = density_g_cm3;
  return pot;
}

inline glm::dvec3 moved(const Collapse& c, const glm::dvec3& p) {
  return c.pivot_mm + glm::angleAxis(c.angle_rad, c.axis) * (p - c.pivot_mm) + c.shift_mm;
}

inline double top_mm(const ClayStack& stack, std::size_t ring) {
  return ring + 1 == stack.size() ? stack.height_mm()
                                  : stack.ring_height_mm() * static_cast<double>(ring + 1);
}

/// Mass above the failed ring [kg], and its centre before the collapse.
struct Weight {
  double kg = 0.0;
  double centre_mm = 0.0;
};
inline Weight weight_above(const Pot& pot, std::size_t failed) {
  const ClayStack& stack = pot.stack;
  const double h = stack.ring_height_mm();
  double volume = stack.mm3_per_quantum() * static_cast<double>(stack.crown());
  double moment = volume * 0.5 * (stack.height_mm() + h * static_cast<double>(stack.size()));
  for (std::size_t i = failed + 1; i < stack.size(); ++i) {
    const double own = stack.mm3_per_quantum() * static_cast<double>(stack.rings()[i].volume());
    volume += own;
    moment += own * h * (static_cast<double>(i) + 0.5);
  }
  return {volume * pot.density_g_cm3 * 1e-6, moment / volume};
}
inline double potential_mj(const Pot& pot, const Collapse& c) {
  const Weight weight = weight_above(pot, c.failed_ring);
  return weight.kg * 9.80665 * moved(c, {0.0, weight.centre_mm, 0.0}).y;
}

/// The lowest corner of all fallen rings, in the plane of the collapse.
inline double lowest_mm(const Pot& pot, const Collapse& c) {
  const ClayStack& stack = pot.stack;
  const glm::dvec3 outward{c.axis.z, 0.0, -c.axis.x};
  double least = 1e300;
  for (std::size_t i = std::min(c.failed_ring + 1, stack.size() - 1); i < stack.size(); ++i)
    for (const double side : {-1.0, 1.0})
      for (const double y :
           {i > c.failed_ring ? stack.ring_height_mm() * static_cast<double>(i)
                              : stack.ring_height_mm() * static_cast<double>(i + 1),
            top_mm(stack, i)}) {
        const glm::dvec3 corner = side * stack.rings()[i].outer_mm() * outward;
        least = std::min(least, moved(c, corner + glm::dvec3{0.0, y, 0.0}).y);
      }
  return least;
}

inline bool in_standing_clay(const Pot& pot, const Collapse& c, const glm::dvec3& p,
                             double slack_mm) {
  const double h = pot.stack.ring_height_mm();
  if (p.y < 0.0 || p.y > h * static_cast<double>(c.failed_ring + 1) + slack_mm) return false;
  const auto level = std::min(c.failed_ring, static_cast<std::size_t>(p.y / h));
  const double radius = std::hypot(p.x, p.z);
  return radius <= pot.stack.rings()[level].outer_mm() + slack_mm &&
         radius >= pot.stack.rings()[level].inner_mm() - slack_mm;
}

/// Calls use(position before the collapse, unit normal, area) for surface elements of the fallen
/// rings, at most `cell_mm` large. Requires a pot without a crown.
template <class Use>
void for_each_element(const Pot& pot, std::size_t failed, double cell_mm, Use use) {
  const auto rings = pot.stack.rings();
  const double h = pot.stack.ring_height_mm();
  const auto round = [&](double radius, double y, double area, auto normal_at) {
    const int n = std::max(8, static_cast<int>(2.0 * kPi * radius / cell_mm));
    for (int k = 0; k < n; ++k) {
      const double a = 2.0 * kPi * (k + 0.37) / n;
      const glm::dvec3 out{std::cos(a), 0.0, std::sin(a)};
      use(radius * out + glm::dvec3{0.0, y, 0.0}, normal_at(out), area / n);
    }
  };
  const auto wall = [&](double radius, double bottom, double sign) {
    const int n = std::max(1, static_cast<int>(std::ceil(h / cell_mm)));
    for (int k = 0; k < n; ++k)
      round(radius, bottom + (k + 0.5) * h / n, 2.0 * kPi * radius * h / n,
            [&](const glm::dvec3& out) { return sign * out; });
  };
  const auto tread = [&](double from, double to, double y, double up) {
    if (!(to > from)) return;
    const int n = std::max(1, static_cast<int>(std::ceil((to - from) / cell_mm)));
    for (int k = 0; k < n; ++k) {
      const double a = from + (to - from) * k / n, b = from + (to - from) * (k + 1) / n;
      round(0.5 * (a + b), y, kPi * (b * b - a * a), [&](const glm::dvec3&) {
        return glm::dvec3{0.0, up, 0.0};
      });
    }
  };
  for (std::size_t i = failed + 1; i < rings.size(); ++i) {
    const double bottom = h * static_cast<double>(i);
    const double inner = rings[i].inner_mm(), outer = rings[i].outer_mm();
    wall(outer, bottom, 1.0);
    if (inner > 0.0) wall(inner, bottom, -1.0);
    // Skips the part covered by a neighbour: uses the annuli inside and outside of it.
    const auto face = [&](bool covered, const Ring& by, double y, double up) {
      if (!covered) return tread(inner, outer, y, up);
      tread(inner, std::min(outer, by.inner_mm()), y, up);
      tread(std::max(inner, by.outer_mm()), outer, y, up);
    };
    face(i > failed + 1, rings[i - 1], bottom, -1.0);
    face(i + 1 < rings.size(), rings[std::min(i + 1, rings.size() - 1)], bottom + h, 1.0);
  }
}

/// An element of the fallen surface in the standing clay, or within `slack_mm` of it.
struct Touch {
  glm::dvec3 position_mm, normal;
  double area_mm2;
};
inline std::vector<Touch> touches(const Pot& pot, const Collapse& c, double cell_mm,
                                  double slack_mm) {
  std::vector<Touch> found;
  for_each_element(pot, c.failed_ring, cell_mm,
                   [&](const glm::dvec3& before, const glm::dvec3& n, double area) {
                     const glm::dvec3 p = moved(c, before);
                     if (in_standing_clay(pot, c, p, slack_mm))
                       found.push_back({p, glm::angleAxis(c.angle_rad, c.axis) * n, area});
                   });
  return found;
}

/// Net power [mW] of a motion of the fallen part, given the velocity of each point [mm/s].
template <class Velocity>
double net_power_mw(const Pot& pot, const Collapse& c, const std::vector<Touch>& in_clay,
                    Velocity velocity) {
  const Weight weight = weight_above(pot, c.failed_ring);
  const glm::dvec3 centre = moved(c, {0.0, weight.centre_mm, 0.0});
  double power = -weight.kg * 9.80665 * velocity(centre).y;
  for (const Touch& touch : in_clay)
    power -= 1e-3 * c.threshold_kpa * touch.area_mm2 *
             std::max(0.0, glm::dot(touch.normal, velocity(touch.position_mm)));
  return power;
}

}  // namespace clay::falls
