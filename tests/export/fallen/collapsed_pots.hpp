#pragma once
// Collapsed pots, and the resting place of a point, by quaternions, which the export does not use.

#include "claystack/engine/clay.hpp"
#include "tests/export/solid/shapes.hpp"

#include <rapidcheck.h>

#include <cmath>
#include <glm/gtc/quaternion.hpp>
#include <numbers>

namespace clay::solid::shapes {

/// Falls about an axis through `pivot_mm`, perpendicular to the direction `toward_rad` about the
/// wheel.
inline Pot fallen(ClayStack stack, std::size_t failed_ring, glm::dvec3 pivot_mm, double angle_rad,
                  double toward_rad = 0.0) {
  Pot pot = pot_of(std::move(stack));
  const glm::dvec3 axis{-std::sin(toward_rad), 0.0, std::cos(toward_rad)};
  pot.collapse = Collapse{failed_ring, pivot_mm, axis, angle_rad, 4.0};
  return pot;
}

/// Resting place of a point of the upper part; both with y up.
inline glm::dvec3 fallen_point(const Collapse& collapse, const glm::dvec3& p) {
  return collapse.pivot_mm + collapse.shift_mm +
         glm::angleAxis(collapse.angle_rad, collapse.axis) * (p - collapse.pivot_mm);
}
inline glm::dvec3 point_before_fall(const Collapse& collapse, const glm::dvec3& p) {
  return collapse.pivot_mm + glm::angleAxis(-collapse.angle_rad, collapse.axis) *
                                 (p - collapse.pivot_mm - collapse.shift_mm);
}

/// Any stack with any collapse: along and across the axes, by quarter and half turns, and not at
/// all.
inline rc::Gen<Pot> any_fallen_pot() {
  return rc::gen::exec([] {
    const ClayStack stack = *any_stack();
    const auto failed = *rc::gen::inRange<std::size_t>(0, stack.size());
    const double any_angle = *rc::gen::inRange(0, 3142) * 1e-3;
    const double angle = *rc::gen::element(0.0, 0.5 * std::numbers::pi, std::numbers::pi, any_angle,
                                           any_angle, any_angle);
    const double toward = *rc::gen::inRange(0, 2) * *rc::gen::inRange(0, 6283) * 1e-3;
    const double x = *rc::gen::inRange(0, 14);
    const double cut = 1.5 * static_cast<double>(failed + 1);
    const double y = *rc::gen::element(cut, static_cast<double>(*rc::gen::inRange(0, 20)));
    Pot pot = fallen(stack, failed, {x * std::cos(toward), y, x * std::sin(toward)}, angle, toward);
    const double shift = *rc::gen::inRange(0, 2) * *rc::gen::inRange(-50, 50) * 0.1;
    pot.collapse->shift_mm = {shift * std::cos(toward), -0.7 * std::abs(shift),
                              shift * std::sin(toward)};
    return pot;
  });
}

}  // namespace clay::solid::shapes

namespace clay {
/// For RapidCheck's counterexamples.
inline void showValue(const Pot& pot, std::ostream& out) {
  showValue(pot.stack, out);
  if (!pot.collapse) return;
  const Collapse& c = *pot.collapse;
  out << " failed " << c.failed_ring << " pivot " << c.pivot_mm.x << ' ' << c.pivot_mm.y << ' '
      << c.pivot_mm.z << " axis " << c.axis.x << ' ' << c.axis.z << " angle " << c.angle_rad
      << " shift " << c.shift_mm.x << ' ' << c.shift_mm.y << ' ' << c.shift_mm.z;
}
}  // namespace clay
