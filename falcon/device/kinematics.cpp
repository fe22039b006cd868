#include "falcon/device/kinematics.hpp"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>
#include <glm/vec2.hpp>
#include <glm/vector_relational.hpp>
#include <limits>
#include <numbers>

namespace clay::falcon::inline device {
namespace {

constexpr int kLegs = 3;
constexpr int kMaxSteps = 16;
// Full Newton steps from the centre overshoot poses at the border of the workspace.
constexpr double kLongestStepMm = 15.0;
// Newton doubles the digits: the step after one this short would be below rounding.
constexpr double kLastStepMm = 1e-6;
// Minimum volume of the box of three unit vectors; below it they count as coplanar.
constexpr double kFlat = 1e-9;

double squared(double x) { return x * x; }

double rad_per_count(const Geometry& g) {
  return 2.0 * std::numbers::pi / (kCountsPerMotorTurn * g.gear_ratio);
}

LegCounts to_counts(const glm::dvec3& whole) {
  return {static_cast<std::int16_t>(whole.x), static_cast<std::int16_t>(whole.y),
          static_cast<std::int16_t>(whole.z)};
}

tl::unexpected<KinematicsError> failed(KinematicsError error) { return tl::make_unexpected(error); }

/// The grip's joint in a leg's own frame [mm].
struct LegPoint {
  double u, v, w;
  double across;  // b sin t3: the parallelogram's extent in the leg's plane; NaN out of reach
};

LegPoint in_leg_frame(const Geometry& g, const glm::dvec2& direction,
                      const glm::dvec3& position) noexcept {
  const double along = direction.x * position.x + direction.y * position.y;
  const double aside = direction.x * position.y - direction.y * position.x;
  const double u = along - g.base_radial_mm + g.grip_radial_mm;
  const double v = aside - g.base_lateral_mm + g.grip_lateral_mm;
  return {u, v, position.z, std::sqrt(squared(g.shin_mm) - squared(v))};
}

/// The vectors between the knees of thighs at given angles and the grip at a given position, one
/// column or number per leg.
struct Shins {
  glm::dmat3 gradients{0.0};  // of the gap by the position: (cos t2, cot t3, sin t2) rotated by phi
  glm::dvec3 gaps_mm{0.0};    // distance minus shin length; 0 in a true pose
  glm::dvec3 levers_mm{0.0};  // a sin(t2 - t1): lever of a force along the shin about the hip
};

Shins shins_between(const Geometry& g, const glm::dmat3x2& directions, const glm::dvec3& angles,
                    const glm::dvec3& position) noexcept {
  Shins shins;
  for (int leg = 0; leg < kLegs; ++leg) {
    const glm::dvec2& direction = directions[leg];
    const LegPoint point = in_leg_frame(g, direction, position);
    const glm::dvec2 thigh = g.thigh_mm * glm::dvec2(std::cos(angles[leg]), std::sin(angles[leg]));
    const glm::dvec2 way = glm::dvec2(point.u, point.w) - thigh;
    const double length = glm::length(way);
    const double du = way.x / length, dv = point.v / point.across, dw = way.y / length;
    shins.gradients[leg] = {direction.x * du - direction.y * dv,
                            direction.y * du + direction.x * dv, dw};
    shins.gaps_mm[leg] = length - g.shin_ends_mm - point.across;
    shins.levers_mm[leg] = thigh.x * dw - thigh.y * du;
  }
  return shins;
}

/// Inverse of a matrix with one column per leg; empty if the columns are coplanar or not finite.
std::optional<glm::dmat3> inverse_of(const glm::dmat3& columns) noexcept {
  const double box = glm::length(columns[0]) * glm::length(columns[1]) * glm::length(columns[2]);
  if (!(std::abs(glm::determinant(columns)) > kFlat * box)) return std::nullopt;
  return glm::inverse(columns);
}

}  // namespace

Kinematics::Kinematics(const Geometry& geometry) noexcept : geometry_(geometry) {
  for (int leg = 0; leg < kLegs; ++leg)
    directions_[leg] = {std::cos(kLegDirectionsRad[leg]), std::sin(kLegDirectionsRad[leg])};
}

std::optional<double> Kinematics::thigh_angle(int leg,
                                              const glm::dvec3& position_mm) const noexcept {
  const LegPoint point = in_leg_frame(geometry_, directions_[leg], position_mm);
  // Hip, knee and grip form a triangle: the law of cosines.
  const double thigh = geometry_.thigh_mm, shin = geometry_.shin_ends_mm + point.across;
  const double reach = std::hypot(point.u, point.w);
  const double cosine = (squared(reach) + squared(thigh) - squared(shin)) / (2.0 * thigh * reach);
  if (!(point.across > 0.0 && std::abs(cosine) < 1.0)) return std::nullopt;
  return std::atan2(point.w, point.u) - std::acos(cosine);
}

Solved<glm::dvec3> Kinematics::inverse(const glm::dvec3& position_mm) const noexcept {
  constexpr KinematicsError kUnreachable[] = {KinematicsError::top_leg_unreachable,
                                              KinematicsError::right_leg_unreachable,
                                              KinematicsError::left_leg_unreachable};
  glm::dvec3 angles(0.0);
  for (int leg = 0; leg < kLegs; ++leg) {
    const auto angle = thigh_angle(leg, position_mm);
    if (!angle) return failed(kUnreachable[leg]);
    angles[leg] = *angle;
  }
  return angles;
}

Solved<glm::dvec3> Kinematics::forward(const glm::dvec3& angles_rad,
                                       const glm::dvec3& start_mm) const noexcept {
  glm::dvec3 position = start_mm;
  for (int steps = 0; steps < kMaxSteps; ++steps) {
    const Shins shins = shins_between(geometry_, directions_, angles_rad, position);
    const auto inverse = inverse_of(shins.gradients);
    if (!inverse) break;
    // A vector times the inverse solves the transposed system: Newton's matrix has the gradients as
    // rows.
    const glm::dvec3 step = shins.gaps_mm * *inverse;
    const double length = glm::length(step);
    position -= std::min(1.0, kLongestStepMm / length) * step;
    if (length > kLastStepMm) continue;
    if (!glm::all(glm::greaterThan(shins.levers_mm, glm::dvec3(0.0)))) break;
    return position;
  }
  return failed(KinematicsError::not_converged);
}

Solved<glm::dmat3> Kinematics::jacobian(const glm::dvec3& position_mm) const noexcept {
  return inverse(position_mm).map([&](const glm::dvec3& angles) {
    const Shins shins = shins_between(geometry_, directions_, angles, position_mm);
    glm::dmat3 rows = shins.gradients;
    for (int leg = 0; leg < kLegs; ++leg) rows[leg] /= shins.levers_mm[leg];
    return glm::transpose(rows);
  });
}

Solved<glm::dvec3> Kinematics::torques(const glm::dvec3& position_mm,
                                       const glm::dvec3& force_n) const noexcept {
  return jacobian(position_mm).and_then([&](const glm::dmat3& j) -> Solved<glm::dvec3> {
    const auto inverse = inverse_of(glm::transpose(j));
    if (!inverse) return failed(KinematicsError::singular);
    return *inverse * force_n;
  });
}

glm::dvec3 Kinematics::angles_of(const LegCounts& counts) const noexcept {
  return geometry_.zero_angle_rad +
         rad_per_count(geometry_) * glm::dvec3(counts[0], counts[1], counts[2]);
}

Solved<LegCounts> Kinematics::counts_of(const glm::dvec3& angles_rad) const noexcept {
  using Limits = std::numeric_limits<LegCounts::value_type>;
  const glm::dvec3 counts =
      glm::round((angles_rad - geometry_.zero_angle_rad) / rad_per_count(geometry_));
  const bool held = glm::all(glm::greaterThanEqual(counts, glm::dvec3(Limits::min()))) &&
                    glm::all(glm::lessThanEqual(counts, glm::dvec3(Limits::max())));
  if (!held) return failed(KinematicsError::beyond_encoder);
  return to_counts(counts);
}

LegCounts motor_counts(const glm::dvec3& torques_nmm, double counts_per_nmm) noexcept {
  const glm::dvec3 asked = -counts_per_nmm * torques_nmm, size = glm::abs(asked);
  if (!glm::all(glm::lessThan(size, glm::dvec3(std::numeric_limits<double>::infinity()))))
    return {};
  const double peak = std::max({size.x, size.y, size.z});
  return to_counts(glm::round((peak > kMotorLimit ? kMotorLimit / peak : 1.0) * asked));
}

}  // namespace clay::falcon::inline device
