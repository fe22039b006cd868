#include "app/bench/extreme/overlap_energy.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace clay::extreme {

Section section_of(const Subject& subject) {
  Section section;
  for (std::size_t i = 0; i < subject.rings(); ++i) {
    section.rings.push_back(subject.ring(i));
    section.centres_mm.push_back(subject.centre_mm(i));
  }
  return section;
}

double half_height_mm(const ToolShapeSpec& shape) {
  if (const auto* sphere = std::get_if<SphereSpec>(&shape)) return sphere->radius_mm;
  if (const auto* ellipse = std::get_if<EllipseSpec>(&shape)) return ellipse->half_height_mm;
  return 0.5 * std::get<RibSpec>(shape).height_mm;
}

Fifty half_profile(const ToolShapeSpec& shape, const Fifty& t) {
  if (const auto* rib = std::get_if<RibSpec>(&shape)) return rib->radius_mm;
  const Fifty a = half_height_mm(shape);
  const auto* ellipse = std::get_if<EllipseSpec>(&shape);
  const Fifty b = ellipse ? Fifty(ellipse->half_width_mm) : a;
  const Fifty under = 1 - t * t / (a * a);
  return under > 0 ? Fifty(b * sqrt(under)) : Fifty(0);
}

OverlapEnergy::OverlapEnergy(ToolShapeSpec shape, Section section, double stiffness_n_per_mm2,
                             bool outside)
    : shape_(std::move(shape)),
      section_(std::move(section)),
      stiffness_(stiffness_n_per_mm2),
      ring_height_(section_.centres_mm[1] - section_.centres_mm[0]),
      tools_{{outside, 0.0}} {}

OverlapEnergy::OverlapEnergy(ToolShapeSpec shape, Section section, double stiffness_n_per_mm2,
                             double gap_mm)
    : OverlapEnergy(std::move(shape), std::move(section), stiffness_n_per_mm2, true) {
  const double reach = 0.5 * gap_mm + half_profile(shape_, 0).convert_to<double>();
  tools_ = {{true, reach}, {false, -reach}};
}

/// Integrated in s with t = a sin s, so that f is smooth up to its poles.
double OverlapEnergy::of_ring(std::size_t i, double hip_y, double d, bool outside) const {
  static constexpr double kNodes[] = {0.1834346424956498, 0.5255324099163290, 0.7966664774136267,
                                      0.9602898564975363};
  static constexpr double kWeights[] = {0.3626837833783620, 0.3137066458778873, 0.2223810344533745,
                                        0.1012285362903763};
  const double half = half_height_mm(shape_), middle = section_.centres_mm[i] - hip_y;
  const double from = std::max(middle - 0.5 * ring_height_, -half);
  const double to = std::min(middle + 0.5 * ring_height_, half);
  if (!(to > from)) return 0.0;
  const auto* rib = std::get_if<RibSpec>(&shape_);
  const auto* ellipse = std::get_if<EllipseSpec>(&shape_);
  const double width = rib ? rib->radius_mm : ellipse ? ellipse->half_width_mm : half;
  const auto depth2 = [&](double s) {
    const double f = rib ? width : width * std::cos(s);
    const double depth =
        outside ? section_.rings[i].outer_mm + f - d : d + f - section_.rings[i].inner_mm;
    // f' = -(width / half) tan s; a rib has none.
    const double across = rib ? 1.0 : half * std::cos(s), along = rib ? 0.0 : width * std::sin(s);
    const double cos2 = across * across / (across * across + along * along);
    return depth > 0.0 ? cos2 * depth * depth * half * std::cos(s) : 0.0;
  };
  const double low = std::asin(from / half), high = std::asin(to / half);
  double sum = 0.0;
  for (int k = 0; k < 4; ++k)
    for (const double side : {-1.0, 1.0})
      sum += kWeights[k] * depth2(0.5 * (low + high) + 0.5 * (high - low) * side * kNodes[k]);
  return 0.5 * (high - low) * sum;
}

double OverlapEnergy::at(const glm::dvec3& hip_mm) const {
  double sum = 0.0;
  for (const PlacedTool& tool : tools_) {
    const double d = std::abs(std::hypot(hip_mm.x, hip_mm.z) + tool.from_hip_mm);
    for (std::size_t i = 0; i < section_.rings.size(); ++i)
      sum += of_ring(i, hip_mm.y, d, tool.outside);
  }
  return 0.5 * stiffness_ * sum;
}

glm::dvec3 OverlapEnergy::force_n(const glm::dvec3& hip_mm) const {
  constexpr double kStep = 1e-4;  // E is smooth to third order except at the border of the contact
  glm::dvec3 force(0.0);
  for (int axis = 0; axis < 3; ++axis) {
    glm::dvec3 plus = hip_mm, minus = hip_mm;
    plus[axis] += kStep;
    minus[axis] -= kStep;
    force[axis] = (at(minus) - at(plus)) / (2.0 * kStep);
  }
  return force;
}

}  // namespace clay::extreme
