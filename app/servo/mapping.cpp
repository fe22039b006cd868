#include "app/servo/mapping.hpp"

#include "core/limit_norm.hpp"

#include <glm/geometric.hpp>

namespace clay::servo {
namespace {

glm::dvec3 middle_mm(const MappingSettings& settings) {
  const double reach = settings.reach_mm;
  switch (settings.side) {
    case Side::left:
      return {-reach, settings.height_mm, 0.0};
    case Side::front:
      return {0.0, settings.height_mm, reach};
    case Side::right:
      break;
  }
  return {reach, settings.height_mm, 0.0};
}

}  // namespace

Result<void> check_range(const char* setting, double value, double low, double high) {
  if (value >= low && value <= high) return {};
  return tl::make_unexpected(falcon::error_of({setting, low, high, value}));
}

Result<Mapping> Mapping::build(const MappingSettings& settings) {
  const auto checked =
      check_range("scale", settings.scale, 0.1, 10.0)
          .and_then([&] { return check_range("force_gain", settings.force_gain, 0.0, 10.0); })
          .and_then([&] { return check_range("reach_mm", settings.reach_mm, 0.0, 1000.0); })
          .and_then([&] { return check_range("height_mm", settings.height_mm, -1000.0, 1000.0); });
  if (!checked) return tl::make_unexpected(checked.error());
  Mapping mapping;
  mapping.scale_ = settings.scale;
  mapping.force_gain_ = settings.force_gain > 0.0 ? settings.force_gain : 1.0 / settings.scale;
  mapping.turned_ = {settings.flip_x ? -1.0 : 1.0, settings.flip_y ? -1.0 : 1.0,
                     settings.flip_z ? -1.0 : 1.0};
  mapping.offset_mm_ = middle_mm(settings);
  return mapping;
}

glm::dvec3 Mapping::to_clay(const glm::dvec3& device_mm) const noexcept {
  return offset_mm_ + scale_ * turned_ * device_mm;
}

glm::dvec3 Mapping::to_device(const glm::dvec3& clay_mm) const noexcept {
  return turned_ * (clay_mm - offset_mm_) / scale_;
}

glm::dvec3 Mapping::force_to_device(const glm::dvec3& clay_n) const noexcept {
  return force_gain_ * turned_ * clay_n;
}

void Mapping::recentre(const glm::dvec3& device_mm, const glm::dvec3& clay_mm) noexcept {
  offset_mm_ = clay_mm - scale_ * turned_ * device_mm;
}

HandForce::Wanted HandForce::answer(std::int64_t now_us, const glm::dvec3& device_mm,
                                    const Mapping& mapping, const StepReport& clay) noexcept {
  const falcon::PassiveForce passive =
      controller_.tick(now_us, device_mm, mapping.force_to_device(clay.spring_n));
  const double contact_n = norm(mapping.force_to_device(clay.force_n()));
  spring_n_ = whole_n_ = {};
  if (passive.state == falcon::PassivityState::safe) return {{}, false, contact_n};
  spring_n_ = passive.force_n;
  whole_n_ = spring_n_ + mapping.force_to_device(clay.friction_n);
  return {whole_n_, true, contact_n};
}

void HandForce::displayed(const glm::dvec3& sent_n) noexcept {
  const double whole = glm::length(whole_n_);
  controller_.displayed(whole > 0.0 ? glm::length(sent_n) / whole * spring_n_ : glm::dvec3(0.0));
}

}  // namespace clay::servo
