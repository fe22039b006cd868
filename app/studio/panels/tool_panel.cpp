// What the hand holds, and how the wheel turns.

#include "app/studio/panels/panels.hpp"
#include "app/studio/panels/widgets.hpp"

#include <fmt/format.h>

#include <array>

namespace clay::studio {
namespace {

constexpr std::array kModes = {"Press", "Trim", "Pinch"};
constexpr std::array kShapes = {"Sphere", "Ellipse", "Rib", "Own"};
constexpr double kSoftest = 1e-3, kStiffest = 1.0;  // N/mm2

const char* words_of(ToolMode mode) {
  switch (mode) {
    case ToolMode::press:
      return "Presses clay aside; none is lost. Ctrl trims meanwhile.";
    case ToolMode::trim:
      return "Cuts clay off. Ctrl presses meanwhile.";
    case ToolMode::pinch:
      break;
  }
  return "Two hands, one on each side of the wall: drag up to pull it.";
}

}  // namespace

void draw_tool(AppState& shop) {
  ToolChoice& tool = shop.settings.tool;
  const LengthUnit unit = shop.settings.unit;
  if (const int mode = choice_row("mode", kModes, static_cast<int>(tool.mode), shop.colours());
      mode >= 0)
    tool.mode = static_cast<ToolMode>(mode);
  faint_text(shop.colours(), words_of(tool.mode));
  const std::size_t shapes = tool.own.t_mm.empty() ? 3 : 4;
  if (const int shape = choice_row("shape", std::span(kShapes).first(shapes),
                                   static_cast<int>(tool.shape), shop.colours());
      shape >= 0)
    tool.shape = static_cast<Shape>(shape);
  const auto size = [&](const char* label, double& mm) {
    length_slider(label, mm, kSmallestToolMm, kLargestToolMm, unit);
  };
  switch (tool.shape) {
    case Shape::sphere:
      size("Radius", tool.sphere.radius_mm);
      break;
    case Shape::ellipse:
      size("Half height", tool.ellipse.half_height_mm);
      size("Half width", tool.ellipse.half_width_mm);
      break;
    case Shape::rib:
      size("Height", tool.rib.height_mm);
      size("Radius", tool.rib.radius_mm);
      break;
    case Shape::own:
      faint_text(shop.colours(), fmt::format("{} points, from the scene", tool.own.t_mm.size()));
      break;
  }
  if (tool.mode == ToolMode::pinch)
    length_slider("Gap", tool.gap_mm, kNarrowestGapMm, kWidestPinchMm, unit);
}

void draw_wheel(AppState& shop) {
  ImGui::TextUnformatted("Speed");
  float rpm = static_cast<float>(shop.settings.wheel_rpm);
  ImGui::SetNextItemWidth(-1.0f);
  if (ImGui::SliderFloat("##rpm", &rpm, static_cast<float>(kSlowestRpm),
                         static_cast<float>(kFastestRpm), "%.0f rpm", ImGuiSliderFlags_AlwaysClamp))
    shop.settings.wheel_rpm = static_cast<double>(rpm);
  faint_text(shop.colours(), "The faster it turns, the faster the clay gives way.");
  if (!shop.potter.has_work() || !shop.potter.scene().force) return;
  ImGui::TextUnformatted("Stiffness");
  float stiffness = static_cast<float>(shop.potter.scene().force->stiffness_n_per_mm2);
  ImGui::SetNextItemWidth(-1.0f);
  if (ImGui::SliderFloat("##stiffness", &stiffness, static_cast<float>(kSoftest),
                         static_cast<float>(kStiffest), "%.3g N/mm\xc2\xb2",
                         ImGuiSliderFlags_AlwaysClamp | ImGuiSliderFlags_Logarithmic))
    shop.potter.set_stiffness(static_cast<double>(stiffness));
  faint_text(shop.colours(), "What the hand feels; the clay moves the same.");
}

}  // namespace clay::studio
