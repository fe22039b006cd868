// The goal: the desired capacity and size of the pot, and the target profile.

#include "app/studio/commands.hpp"
#include "app/studio/panels/panels.hpp"
#include "app/studio/panels/value_slider.hpp"
#include "app/studio/panels/widgets.hpp"
#include "app/studio/samples.hpp"

#include <fmt/format.h>

#include <array>
#include <cmath>
#include <optional>
#include <string_view>
#include <utility>

namespace clay::studio {
namespace {

/// A slider from 0, for whole numbers; `none`: text shown for 0.
void slider(const char* label, double& value, double most, const std::string& text,
            const char* none, const ValueUnits& units) {
  float shown = static_cast<float>(value);
  if (panel_slider(label, shown, 0.0f, static_cast<float>(most), value > 0.0 ? text : none, units))
    value = std::round(static_cast<double>(shown));
}

/// The command that chose this target: that of its sample, or of a file.
std::string_view command_of(const Target* target) {
  if (target == nullptr) return "goal.none";
  for (const Command& command : commands())
    if (const auto* sample = std::get_if<UseSampleTarget>(&command.action);
        sample != nullptr && samples().at(sample->index).title == target->name)
      return command.id;
  return "goal.file";
}

void choose_target(const ViewModel& model, Actions& actions) {
  constexpr std::array<std::string_view, 6> kChoices = {
      "goal.none", "goal.bowl", "goal.vase", "goal.bottle", "goal.cylinder", "goal.file"};
  const Target* target = model.ui.target.get();
  ImGui::TextUnformatted("Target profile");
  ImGui::SetNextItemWidth(kToEdge);
  if (!begin_list("Target profile", target != nullptr ? target->name.c_str() : "None")) return;
  const std::string_view present = command_of(target);
  for (const std::string_view id : kChoices) {
    if (ImGui::Selectable(find_command(id)->title, id == present))
      actions.emplace_back(RunCommand{id});
    if (id == present) ImGui::SetItemDefaultFocus();
  }
  ImGui::EndCombo();
}

}  // namespace

void draw_goal(const ViewModel& model, Actions& actions) {
  PotGoal goal = model.settings.goal;
  const LengthUnit unit = model.settings.unit;
  constexpr double kUsualMl = 1500.0, kUsualMm = 300.0;
  slider("Capacity", goal.holds_ml, kUsualMl, fmt::format("{:.0f} ml", goal.holds_ml), "any",
         kVolumes);
  const auto length = [&](const char* label, double& mm) {
    slider(label, mm, kUsualMm, length_text(mm, unit), "any", lengths_in(unit));
  };
  length("Height", goal.height_mm);
  length("Diameter", goal.diameter_mm);
  slider("Shrinkage", goal.shrinkage_percent, kMostShrinkagePercent,
         fmt::format("{:.0f} %", goal.shrinkage_percent), "not fired", kPercent);
  if (goal != model.settings.goal) actions.emplace_back(SetGoal{goal});
  choose_target(model, actions);
}

namespace {

/// One side of a wall in the view, from the foot up.
using WallLine = std::vector<ImVec2>;

WallLine wall_line(const ViewModel& model, const render::PotView& pot, double side,
                   float render::Row::*radius) {
  WallLine line;
  const double row_mm = pot.height_mm / static_cast<double>(pot.rows.size());
  for (std::size_t row = 0; row < pot.rows.size(); ++row) {
    const double rho_mm = side * static_cast<double>(pot.rows[row].*radius);
    const auto at = model.scene.pixel_of({rho_mm, row_mm * (static_cast<double>(row) + 0.5)});
    if (!at) return {};
    line.emplace_back(at->x, at->y);
  }
  return line;
}

/// The wall between both lines, and its edge: up the outside, over the lip, down the bore and along
/// the floor to the axis.
void draw_target_side(ImDrawList* draw, const render::PotView& pot, const WallLine& outer,
                      const WallLine& inner) {
  const ImVec4 ink = ImGui::GetStyleColorVec4(ImGuiCol_Text);
  const ImU32 face = ImGui::GetColorU32(ImVec4(ink.x, ink.y, ink.z, 0.13f));
  for (std::size_t row = 1; row < outer.size(); ++row)
    draw->AddQuadFilled(inner[row - 1], outer[row - 1], outer[row], inner[row], face);
  WallLine edge = outer;
  for (std::size_t row = inner.size(); row-- > 0;) {
    edge.push_back(inner[row]);
    if (pot.rows[row].inner_mm > 0.0f || row + 1 == inner.size()) continue;
    edge.back().y = inner[row + 1].y;  // the floor is level
    break;
  }
  draw->AddPolyline(edge.data(), static_cast<int>(edge.size()),
                    ImGui::GetColorU32(ImVec4(ink.x, ink.y, ink.z, 0.75f)), ImDrawFlags_None,
                    0.12f * ImGui::GetFontSize());
}

}  // namespace

void draw_target(const ViewModel& model, const ViewRect& rect) {
  const Target* target = model.ui.target.get();
  if (target == nullptr || !model.document.has_work() || !model.ui.shows<NoDialog>() ||
      model.readings.fallen() || model.upside_down())
    return;
  const render::PotView& pot = target->view;
  ImDrawList* draw = ImGui::GetBackgroundDrawList();
  draw->PushClipRect({rect.corner_px.x, rect.corner_px.y},
                     {rect.corner_px.x + rect.size_px.x, rect.corner_px.y + rect.size_px.y});
  // Smoothed edges would show every quad.
  const ImDrawListFlags flags =
      std::exchange(draw->Flags, draw->Flags & ~ImDrawListFlags_AntiAliasedFill);
  for (const double side : {1.0, -1.0}) {
    const WallLine outer = wall_line(model, pot, side, &render::Row::outer_mm);
    const WallLine inner = wall_line(model, pot, side, &render::Row::inner_mm);
    if (!outer.empty() && !inner.empty()) draw_target_side(draw, pot, outer, inner);
  }
  draw->Flags = flags;
  draw->PopClipRect();
}

}  // namespace clay::studio
