#include "claystack/falcon/usb.hpp"
#include "falcon/device/setting_ranges.hpp"

#include <algorithm>
#include <glm/common.hpp>
#include <glm/geometric.hpp>

namespace clay::falcon::inline device {
namespace {

constexpr std::uint16_t kLogitech = 0x046d, k3Dconnexion = 0x256f;
constexpr SpaceMouseModel kModels[] = {
    {kLogitech, 0xc603, "SpaceMouse Plus XT"},
    {kLogitech, 0xc605, "CADman"},
    {kLogitech, 0xc606, "SpaceMouse Classic"},
    {kLogitech, 0xc621, "SpaceBall 5000"},
    {kLogitech, 0xc623, "SpaceTraveler"},
    {kLogitech, 0xc625, "SpacePilot"},
    {kLogitech, 0xc626, "SpaceNavigator"},
    {kLogitech, 0xc627, "SpaceExplorer"},
    {kLogitech, 0xc628, "SpaceNavigator for Notebooks"},
    {kLogitech, 0xc629, "SpacePilot Pro"},
    {kLogitech, 0xc62b, "SpaceMouse Pro"},
    {k3Dconnexion, 0xc62e, "SpaceMouse Wireless (cable)"},
    {k3Dconnexion, 0xc62f, "SpaceMouse Wireless (receiver)"},
    {k3Dconnexion, 0xc631, "SpaceMouse Pro Wireless (cable)"},
    {k3Dconnexion, 0xc632, "SpaceMouse Pro Wireless (receiver)"},
    {k3Dconnexion, 0xc633, "SpaceMouse Enterprise"},
    {k3Dconnexion, 0xc635, "SpaceMouse Compact"},
    {k3Dconnexion, 0xc636, "SpaceMouse Module"},
    {k3Dconnexion, 0xc638, "SpaceMouse Pro Wireless BT"},
    {k3Dconnexion, 0xc63a, "SpaceMouse Wireless BT"},
    {k3Dconnexion, 0xc652, "Universal Receiver"},
};

constexpr std::uint8_t kTranslation = 1, kButtons = 3;
constexpr double kFullDeflection = 350.0;
constexpr std::size_t kTranslationBytes = 1 + 3 * 2;
constexpr double kMostDt = 0.05;

double axis(std::span<const std::uint8_t> report, std::size_t index) {
  const unsigned word = report[1 + 2 * index] | static_cast<unsigned>(report[2 + 2 * index]) << 8;
  return std::clamp(static_cast<std::int16_t>(word) / kFullDeflection, -1.0, 1.0);
}

}  // namespace

std::span<const SpaceMouseModel> space_mouse_models() noexcept { return kModels; }

DeviceResult<void> check(const SpaceMouseSettings& settings) {
  const OutOfRange ranges[] = {
      {"speed_mm_s", 1.0, 500.0, settings.speed_mm_s},
      {"dead_zone", 0.0, 0.5, settings.dead_zone},
      {"half_workspace_mm", 10.0, 1000.0, settings.half_workspace_mm},
      {"silence_us", 2e4, 1e6, static_cast<double>(settings.silence_us)},
  };
  if (const auto checked = check_ranges(ranges); !checked)
    return bad_setting("spacemouse", checked.error());
  return {};
}

bool SpaceMouseReports::take(std::span<const std::uint8_t> report) noexcept {
  if (report.size() >= kTranslationBytes && report[0] == kTranslation) {
    // The controller's axes: x right, y to the user, z down.
    deflection_ = {axis(report, 0), -axis(report, 2), axis(report, 1)};
    return true;
  }
  if (report.size() >= 2 && report[0] == kButtons) {
    buttons_ = 0;
    const auto bits = report.subspan(1, std::min<std::size_t>(report.size() - 1, 4));
    for (std::size_t i = 0; i < bits.size(); ++i)
      buttons_ |= static_cast<unsigned>(bits[i]) << (8 * i);
    return true;
  }
  return false;
}

glm::dvec3 rate_of(const glm::dvec3& deflection, double dead_zone) noexcept {
  const double way = std::min(glm::length(deflection), 1.0);
  if (!(way > dead_zone)) return glm::dvec3(0.0);
  const double part = (way - dead_zone) / (1.0 - dead_zone);
  return part * part * glm::normalize(deflection);
}

void RateControl::advance(const glm::dvec3& deflection, std::int64_t now_us) noexcept {
  const double dt = last_us_ == 0 ? 0.0 : 1e-6 * static_cast<double>(now_us - last_us_);
  last_us_ = now_us;
  const glm::dvec3 step = settings_.speed_mm_s * std::clamp(dt, 0.0, kMostDt) *
                          rate_of(deflection, settings_.dead_zone);
  position_mm_ =
      glm::clamp(position_mm_ + step, -settings_.half_workspace_mm, settings_.half_workspace_mm);
}

}  // namespace clay::falcon::inline device
