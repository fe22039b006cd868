// The tool, the wheel, and the force on the hand.

#include "app/studio/panels/panels.hpp"
#include "app/studio/panels/value_slider.hpp"
#include "app/studio/panels/widgets.hpp"
#include "app/studio/tool_choice.hpp"
#include "claystack/engine/plan.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>

namespace clay::studio {
namespace {

constexpr std::array kShapes = {"Sphere", "Ellipse", "Rib", "Custom"};
constexpr double kUsualLimitN = 5.0;

/// On a touch screen no key can be held.
const char* help_text(ToolMode mode, bool fallen, bool fingers) {
  switch (mode) {
    case ToolMode::press:
      return fingers ? "Displaces clay and keeps its volume."
                     : "Displaces clay and keeps its volume. Hold Ctrl to trim.";
    case ToolMode::trim:
      return fingers ? "Removes clay." : "Removes clay. Hold Ctrl to press.";
    case ToolMode::pinch:
      return "Presses from both sides of the wall: drag up to pull it.";
    case ToolMode::smooth:
      return "A wet sponge: evens out the surface and cuts nothing.";
    case ToolMode::needle:
      return "Drag the needle through the wall: the clay above it is removed.";
    case ToolMode::wire:
      return "Drag the wire through the pot to the axis: it cuts the pot off the wheel there.";
    case ToolMode::trim_foot:
      break;
  }
  return fallen ? "Removes clay from the foot. A fallen pot is not turned over."
                : "The pot stands upside down: removes clay from its foot.";
}

/// As a length, or as a part of the wall.
bool draw_gap(ToolChoice& tool, LengthUnit unit) {
  constexpr double kUsualShare = 0.7;
  bool changed = false, share = tool.gap_share > 0.0;
  if (share) {
    float percent = static_cast<float>(100.0 * tool.gap_share);
    changed = panel_slider("Gap", percent, static_cast<float>(100.0 * kLeastGapShare),
                           static_cast<float>(100.0 * kMostGapShare),
                           fmt::format("{:.0f} % of the wall", percent), kPercent);
    if (changed) tool.gap_share = 0.01 * std::round(static_cast<double>(percent));
  } else {
    changed = length_slider("Gap", tool.gap_mm, kNarrowestGapMm, kWidestPinchMm, unit);
  }
  if (!ImGui::Checkbox("As a share of the wall", &share)) return changed;
  tool.gap_share = share ? kUsualShare : 0.0;
  return true;
}

/// Sliders of the selected shape. Returns true if one has moved.
bool draw_sizes(ToolChoice& tool, LengthUnit unit, const Palette& colours) {
  const auto size = [&](const char* label, double& mm) {
    return length_slider(label, mm, kSmallestToolMm, kLargestToolMm, unit);
  };
  bool changed = false;
  switch (tool.shape) {
    case Shape::sphere:
      changed = size("Radius", tool.sphere.radius_mm);
      break;
    case Shape::ellipse:
      changed = size("Half height", tool.ellipse.half_height_mm);
      changed = size("Half width", tool.ellipse.half_width_mm) || changed;
      break;
    case Shape::rib:
      changed = size("Height", tool.rib.height_mm);
      changed = size("Radius", tool.rib.radius_mm) || changed;
      break;
    case Shape::own:
      faint_text(colours, fmt::format("{} points, from the scene", tool.own.t_mm.size()));
      break;
  }
  if (tool.mode == ToolMode::pinch) changed = draw_gap(tool, unit) || changed;
  return changed;
}

/// Bar of the force, with its value readable on both backgrounds.
void draw_bar(float part, const std::string& text, const ImVec4& colour) {
  const ImVec2 at = ImGui::GetCursorScreenPos();
  const float width = ImGui::GetContentRegionAvail().x, height = ImGui::GetFrameHeight();
  const float round = ImGui::GetStyle().FrameRounding;
  const float end = at.x + part * width;
  ImDrawList* draw = ImGui::GetWindowDrawList();
  draw->AddRectFilled(at, {at.x + width, at.y + height}, ImGui::GetColorU32(ImGuiCol_FrameBg),
                      round);
  if (part > 0.0f) draw->AddRectFilled(at, {end, at.y + height}, ImGui::GetColorU32(colour), round);
  const ImVec2 size = ImGui::CalcTextSize(text.c_str());
  const ImVec2 corner(at.x + 0.5f * (width - size.x), at.y + 0.5f * (height - size.y));
  const auto text_between = [&](float left, float right, const ImVec4& ink) {
    draw->PushClipRect({left, at.y}, {right, at.y + height}, true);
    draw->AddText(corner, ImGui::GetColorU32(ink), text.c_str());
    draw->PopClipRect();
  };
  text_between(at.x, end, ink_on(colour));
  text_between(end, at.x + width, ImGui::GetStyleColorVec4(ImGuiCol_Text));
  ImGui::Dummy({width, height});
}

/// The tool that was chosen during the stroke.
void draw_next_tool(const ViewModel& model, const ToolSpec& used) {
  const ToolSpec next = tool_of(model.settings.tool);
  if (next.mode == used.mode && next.shape == used.shape) return;
  wrapped_text(fmt::format(
      "The next stroke uses: {}{}", name_of(next.mode),
      next.shape == used.shape || cuts_level(next.mode) ? "" : ", with another shape or size"));
}

void draw_shape(const ViewModel& model, ToolChoice tool, Actions& actions) {
  const std::size_t shapes = tool.own.t_mm.empty() ? 3 : 4;
  const int shape =
      choice_row("shape", std::span(kShapes).first(shapes), static_cast<int>(tool.shape));
  if (shape >= 0) actions.emplace_back(SetToolShape{static_cast<Shape>(shape)});
  if (draw_sizes(tool, model.settings.unit, model.colours())) actions.emplace_back(SetTool{tool});
}

}  // namespace

/// A stroke by hand keeps its tool to its end; that of an arm ends with a change of the tool.
void draw_tool(const ViewModel& model, Actions& actions) {
  const bool held = model.stroke.by_hand();
  const ToolSpec used = model.tool_in_use();
  faint_text(model.colours(), help_text(used.mode, model.document.fallen(), model.fingers));
  if (held) draw_next_tool(model, used);
  if (cuts_level(used.mode)) return;
  ToolChoice tool = model.settings.tool;
  if (held) choose(used, tool);
  ImGui::BeginDisabled(held);
  draw_shape(model, tool, actions);
  ImGui::EndDisabled();
}

void draw_wheel(const ViewModel& model, Actions& actions) {
  constexpr std::array kRpm{cli::Unit{"rpm", 1.0}};
  float rpm = static_cast<float>(model.settings.wheel_rpm);
  if (panel_slider("Speed", rpm, static_cast<float>(kSlowestRpm), static_cast<float>(kFastestRpm),
                   fmt::format("{:.0f} rpm", rpm), {kRpm}))
    actions.emplace_back(SetWheelSpeed{static_cast<double>(rpm)});
  faint_text(model.colours(), "The clay yields and smooths faster at a higher speed.");
  if (!model.document.has_work() || !model.document.scene().force) return;
  constexpr std::array kStiffness{cli::Unit{"N/mm\xc2\xb2", 1.0}};
  float stiffness = static_cast<float>(model.document.stiffness());
  if (panel_slider("Stiffness", stiffness, static_cast<float>(kSoftestClay),
                   static_cast<float>(kStiffestClay),
                   fmt::format("{:.3g} {}", stiffness, kStiffness[0].name), {kStiffness},
                   ImGuiSliderFlags_Logarithmic))
    actions.emplace_back(SetStiffness{static_cast<double>(stiffness)});
  faint_text(model.colours(), "Affects the force you feel, not the clay.");
}

void draw_force(const ViewModel& model, Actions&) {
  const servo::LiveStatus& status = model.stroke.status();
  const bool throwing = model.stroke.throwing();
  const double newtons = throwing ? glm::length(status.clay_n) : 0.0;
  const bool limited = model.document.has_work() && model.document.scene().force;
  const double limit_n = limited ? model.document.scene().force->limit_n : kUsualLimitN;
  const float part = static_cast<float>(std::clamp(newtons / limit_n, 0.0, 1.0));
  const Palette& colours = model.colours();
  draw_bar(part, fmt::format("{:.2f} N of {:g} N", newtons, limit_n),
           part >= 1.0f ? colours.warning : colours.faint);
  faint_text(colours, part >= 1.0f     ? "At the limit of the force"
                      : !throwing      ? "No tool in use"
                      : status.contact ? "In contact with the clay"
                                       : "Clear of the clay");
}

}  // namespace clay::studio
