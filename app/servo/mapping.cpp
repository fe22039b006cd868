#include "app/servo/mapping.hpp"

#include <fmt/format.h>

namespace clay::servo {
namespace {

Result<void> check_range(const char* option, double value, double low, double high) {
  if (value >= low && value <= high) return {};
  return failure(
      ErrorKind::bad_input,
      fmt::format("{}: expected a value from {:g} to {:g}, found {:g}", option, low, high, value));
}

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

Result<Mapping> Mapping::build(const MappingSettings& settings) {
  if (auto ok = check_range("--scale", settings.scale, 0.1, 10.0); !ok)
    return tl::make_unexpected(ok.error());
  if (auto ok = check_range("--force-gain", settings.force_gain, 0.0, 10.0); !ok)
    return tl::make_unexpected(ok.error());
  if (auto ok = check_range("--reach", settings.reach_mm, 0.0, 1000.0); !ok)
    return tl::make_unexpected(ok.error());
  if (auto ok = check_range("--height", settings.height_mm, -1000.0, 1000.0); !ok)
    return tl::make_unexpected(ok.error());
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

}  // namespace clay::servo
