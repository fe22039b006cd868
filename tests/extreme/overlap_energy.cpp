#include "extreme/overlap_energy.hpp"

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

OverlapEnergy::OverlapEnergy(ToolShapeSpec shape, Section section, double stiffness_n_per_mm,
                             bool outside)
    : shape_(std::move(shape)),
      section_(std::move(section)),
      stiffness_(stiffness_n_per_mm),
      tools_{{outside, 0.0}} {}

OverlapEnergy::OverlapEnergy(ToolShapeSpec shape, Section section, double stiffness_n_per_mm,
                             double gap_mm)
    : OverlapEnergy(std::move(shape), std::move(section), stiffness_n_per_mm, true) {
  const double reach = 0.5 * gap_mm + half_profile(shape_, 0).convert_to<double>();
  tools_ = {{true, reach}, {false, -reach}};
}

Fifty OverlapEnergy::depth(std::size_t i, const Point& hip, const Standing& tool) const {
  const Fifty t = section_.centres_mm[i] - hip.y;
  if (abs(t) > half_height_mm(shape_)) return 0;
  const Fifty f = half_profile(shape_, t);
  const Fifty d = abs(Fifty(sqrt(Fifty(hip.x * hip.x + hip.z * hip.z)) + tool.from_hip_mm));
  const Fifty depth = tool.outside ? Fifty(section_.rings[i].outer_mm + f - d)
                                   : Fifty(d + f - section_.rings[i].inner_mm);
  return depth > 0 ? depth : Fifty(0);
}

Fifty OverlapEnergy::at(const Point& hip) const {
  Fifty sum = 0;
  for (const Standing& tool : tools_)
    for (std::size_t i = 0; i < section_.rings.size(); ++i) {
      const Fifty overlap = depth(i, hip, tool);
      sum += overlap * overlap;
    }
  return stiffness_ / 2 * sum;
}

glm::dvec3 OverlapEnergy::force_n(const glm::dvec3& hip_mm) const {
  const Fifty step("1e-12");
  glm::dvec3 force(0.0);
  for (int axis = 0; axis < 3; ++axis) {
    Point plus{hip_mm.x, hip_mm.y, hip_mm.z}, minus = plus;
    Fifty Point::*const coordinate = axis == 0 ? &Point::x : axis == 1 ? &Point::y : &Point::z;
    plus.*coordinate += step;
    minus.*coordinate -= step;
    force[axis] = Fifty((at(minus) - at(plus)) / (2 * step)).convert_to<double>();
  }
  return force;
}

bool OverlapEnergy::smooth_at(double hip_y_mm) const {
  const double half = half_height_mm(shape_);
  const double held = std::holds_alternative<RibSpec>(shape_) ? 1.0 - 1e-6 : 127.0 / 128.0;
  for (const double centre : section_.centres_mm) {
    const double u = std::abs(centre - hip_y_mm) / half;
    if (u > held && u < 1.0 + 1e-6) return false;
  }
  return true;
}

std::size_t OverlapEnergy::touched(const glm::dvec3& hip_mm) const {
  const Point hip{hip_mm.x, hip_mm.y, hip_mm.z};
  std::size_t count = 0;
  for (const Standing& tool : tools_)
    for (std::size_t i = 0; i < section_.rings.size(); ++i) count += depth(i, hip, tool) > 0;
  return count;
}

}  // namespace clay::extreme
