#include "engine/collapse/collapse.hpp"

#include "claystack/engine/collapse.hpp"
#include "core/portable_trig.hpp"
#include "engine/collapse/fall_path.hpp"

#include <cmath>
#include <glm/geometric.hpp>

namespace clay {
namespace {

/// Makes half turns exact, so that faces that coincide after them do so to the last bit.
double exact_at_zero(double x) noexcept { return std::abs(x) < 1e-15 ? 0.0 : x; }

}  // namespace

FallenPlace::FallenPlace(const Collapse& collapse) noexcept
    : pivot_mm_(collapse.pivot_mm), axis_(collapse.axis), shift_mm_(collapse.shift_mm) {
  const CosSin turn = cos_sin(collapse.angle_rad);
  cosine_ = exact_at_zero(turn.cosine);
  sine_ = exact_at_zero(turn.sine);
}

/// Rodrigues' formula.
glm::dvec3 FallenPlace::operator()(const glm::dvec3& point_mm) const noexcept {
  if (sine_ == 0.0 && cosine_ == 1.0) return point_mm + shift_mm_;
  const glm::dvec3 arm = point_mm - pivot_mm_;
  return pivot_mm_ + cosine_ * arm + sine_ * glm::cross(axis_, arm) +
         (1.0 - cosine_) * glm::dot(axis_, arm) * axis_ + shift_mm_;
}

Collapse settle(const ClayStack& stack, double density_g_cm3, const Failure& failure,
                const glm::dvec3& hip_mm, double threshold_kpa) {
  const FallPlane plane(hip_mm);
  const auto frames = fall_path(stack, density_g_cm3, failure.ring, plane, threshold_kpa);
  const FallFrame& rest = frames.back();
  return {failure.ring,       hip_mm,
          plane.axis(),       rest.angle_rad,
          failure.stress_kpa, rest.shift_mm,
          threshold_kpa,      frames.front().potential_mj - rest.potential_mj,
          rest.plastic_mj};
}

std::vector<FallFrame> fall_frames(const Pot& pot) {
  if (!pot.collapse || !(pot.collapse->threshold_kpa > 0.0)) return {};
  const Collapse& c = *pot.collapse;
  return fall_path(pot.stack, pot.density_g_cm3, c.failed_ring, FallPlane(c.pivot_mm),
                   c.threshold_kpa);
}

}  // namespace clay
