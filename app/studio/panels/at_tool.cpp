// Over the view: figures at the tool, how hard the hand pulls, the floor to keep, and the veil of a
// pause.

#include "app/studio/panels/panels.hpp"
#include "app/studio/panels/widgets.hpp"
#include "claystack/engine/tick.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <string>
#include <vector>

namespace clay::studio {
namespace {

constexpr double kBoreMm = 2.0;       // a bore begins at this radius
constexpr double kHardPullMm = 15.0;  // way of the spring at which the hand pulls with its strength
constexpr double kSlackMm = 2.0;
constexpr double kFiguresMm = 20.0;  // a tool so near the clay has figures

const render::Row* row_at(const render::PotView& pot, double y_mm) {
  if (pot.rows.empty() || y_mm < 0.0 || y_mm >= pot.height_mm) return nullptr;
  const double rows = static_cast<double>(pot.rows.size());
  return &pot.rows[static_cast<std::size_t>(std::min(y_mm / pot.height_mm * rows, rows - 1.0))];
}

/// The thickness of the floor; empty: no bore yet.
std::optional<double> floor_mm(const render::PotView& pot) {
  const auto open = std::ranges::find_if(
      pot.rows, [](const render::Row& row) { return static_cast<double>(row.inner_mm) > kBoreMm; });
  if (open == pot.rows.end()) return std::nullopt;
  return pot.height_mm * static_cast<double>(open - pot.rows.begin()) /
         static_cast<double>(pot.rows.size());
}

std::vector<std::string> figures_at(const ViewModel& model, const render::ToolView& tool) {
  const LengthUnit unit = model.settings.unit;
  const render::PotView& pot = model.stroke.view();
  const double rho = std::hypot(tool.place_mm.x, tool.place_mm.z);
  std::vector<std::string> lines;
  const render::Row* row = row_at(pot, tool.place_mm.y);
  if (row != nullptr && static_cast<double>(row->inner_mm) > kBoreMm)
    lines.push_back(fmt::format(
        "wall {}", length_text(static_cast<double>(row->outer_mm - row->inner_mm), unit)));
  if (const auto floor = floor_mm(pot); floor && tool.inside)
    lines.push_back(fmt::format("floor {}", length_text(*floor, unit)));
  lines.push_back(fmt::format("radius {}", length_text(rho, unit)));
  lines.push_back(fmt::format("height {}", length_text(tool.place_mm.y, unit)));
  const ToolMode mode = model.settings.tool.mode;
  if (cuts_level(mode) && row != nullptr)
    lines.push_back(fmt::format(
        "cuts off {}",
        length_text(mode == ToolMode::needle ? pot.height_mm - tool.place_mm.y : tool.place_mm.y,
                    unit)));
  if (const auto& strength = model.scene.strength(); strength && model.stroke.throwing())
    lines.push_back(fmt::format("strength {:.0f} %", 100.0 * *strength));
  return lines;
}

/// Beside the tool: at its right, or at its left if there is no room.
void draw_lines(ImDrawList* draw, const std::vector<std::string>& lines, glm::vec2 tool_px,
                float right) {
  const float em = ImGui::GetFontSize(), gap = 3.2f * em;
  float width = 0.0f;
  for (const std::string& line : lines)
    width = std::max(width, ImGui::CalcTextSize(line.c_str()).x);
  ImVec2 at(tool_px.x + gap, tool_px.y - 2.0f * em);
  if (at.x + width + em > right) at.x = tool_px.x - gap - width;
  const float height = 1.25f * em * static_cast<float>(lines.size());
  draw->AddRectFilled({at.x - 0.5f * em, at.y - 0.3f * em},
                      {at.x + width + 0.5f * em, at.y + height + 0.1f * em},
                      ImGui::GetColorU32(ImGuiCol_PopupBg, kOverView), 0.4f * em);
  for (const std::string& line : lines) {
    draw->AddText(at, ImGui::GetColorU32(ImGuiCol_Text), line.c_str());
    at.y += 1.25f * em;
  }
}

/// The spring between the tool and the pointer, and a gauge around the tool.
void draw_pull(const ViewModel& model, ImDrawList* draw, glm::vec2 tool_px) {
  const double stretch = model.stroke.stretch_mm();
  if (stretch < kSlackMm) return;
  const float em = ImGui::GetFontSize();
  const float part = static_cast<float>(std::clamp(stretch / kHardPullMm, 0.0, 1.0));
  const Palette& colours = model.colours();
  const ImU32 ink = ImGui::GetColorU32(part < 1.0f ? colours.good : colours.warning);
  const glm::vec2 pointer = model.scene.pointer_px();
  if (model.guide.demonstration() == Demonstration::none)
    draw->AddLine({tool_px.x, tool_px.y}, {pointer.x, pointer.y}, ink, 0.1f * em);
  constexpr float kTop = -1.5707963f, kTurn = 6.2831853f;
  draw->PathArcTo({tool_px.x, tool_px.y}, 1.1f * em, kTop, kTop + part * kTurn, 32);
  draw->PathStroke(ink, ImDrawFlags_None, 0.22f * em);
}

/// The clay below this line stays: no tool opens the bottom deeper. Its text stands beside the
/// line, or below it if the view, which begins at `view_left`, is too narrow.
void draw_floor(const ViewModel& model, ImDrawList* draw, float view_left) {
  if (!model.document.scene().clay || model.document.scene().clay->floor_mm <= 0.0) return;
  const double y_mm = model.document.scene().clay->floor_mm;
  const render::Row* row = row_at(model.stroke.view(), y_mm);
  if (row == nullptr) return;
  const double reach = static_cast<double>(row->outer_mm);
  const auto left = model.scene.pixel_of({-reach, y_mm}),
             right = model.scene.pixel_of({reach, y_mm});
  if (!left || !right) return;
  const float em = ImGui::GetFontSize(), dash = 0.5f * em;
  const ImU32 ink = ImGui::GetColorU32(model.colours().faint);
  for (float x = left->x; x < right->x; x += 2.0f * dash)
    draw->AddLine({x, left->y}, {std::min(x + dash, right->x), left->y}, ink, 0.1f * em);
  const std::string text = fmt::format("floor stop {}", length_text(y_mm, model.settings.unit));
  const float beside = left->x - 0.7f * em - ImGui::CalcTextSize(text.c_str()).x;
  const float least = view_left + 0.5f * em;
  const ImVec2 at =
      beside >= least ? ImVec2(beside, left->y - 0.5f * em) : ImVec2(least, left->y + 0.4f * em);
  shaded_text(draw, at, text, ImGui::GetStyleColorVec4(ImGuiCol_Text));
}

/// Needle and wire are too thin to see: a line shows the level at which they cut.
void draw_cut_level(const ViewModel& model, ImDrawList* draw, double y_mm, double widest_mm) {
  constexpr double kBesideMm = 12.0;
  const double reach = widest_mm + kBesideMm;
  const auto left = model.scene.pixel_of({-reach, y_mm}),
             right = model.scene.pixel_of({reach, y_mm});
  if (!left || !right) return;
  const float em = ImGui::GetFontSize();
  draw->AddLine({left->x, left->y}, {right->x, right->y}, ImGui::GetColorU32(ImGuiCol_Text),
                0.14f * em);
}

}  // namespace

void draw_at_tool(const ViewModel& model, const ViewRect& rect) {
  if (!model.document.has_work() || !model.ui.shows<NoDialog>()) return;
  // Not of a pot upside down, or a fallen one.
  if (model.settings.tool.mode == ToolMode::trim_foot || model.readings.fallen()) return;
  const auto tool = model.scene.tool_view(model);
  if (!tool) return;
  const double rho = std::hypot(tool->place_mm.x, tool->place_mm.z);
  const auto place = render::pixel_of(model.scene.camera(), model.scene.viewport(), tool->place_mm);
  if (!place) return;
  const glm::vec2 at = glm::vec2(*place) + rect.corner_px;
  ImDrawList* draw = ImGui::GetBackgroundDrawList();
  draw->PushClipRect({rect.corner_px.x, rect.corner_px.y},
                     {rect.corner_px.x + rect.size_px.x, rect.corner_px.y + rect.size_px.y});
  const render::Row* row = row_at(model.stroke.view(), tool->place_mm.y);
  const double widest = row != nullptr ? static_cast<double>(row->outer_mm) : 0.0;
  const bool near = model.stroke.throwing() || rho < widest + kFiguresMm;
  if (near && (tool->inside || rho < kBoreMm + 20.0)) draw_floor(model, draw, rect.corner_px.x);
  if (cuts_level(model.settings.tool.mode)) draw_cut_level(model, draw, tool->place_mm.y, widest);
  draw_pull(model, draw, at);
  if (near) draw_lines(draw, figures_at(model, *tool), at, rect.corner_px.x + rect.size_px.x);
  draw->PopClipRect();
}

void draw_pause(const ViewModel& model, const ViewRect& rect) {
  if (!model.stroke.paused() || !model.document.has_work() || !model.ui.shows<NoDialog>()) return;
  ImDrawList* draw = ImGui::GetBackgroundDrawList();
  const ImVec2 low(rect.corner_px.x, rect.corner_px.y);
  const ImVec2 high(low.x + rect.size_px.x, low.y + rect.size_px.y);
  draw->AddRectFilled(low, high, ImGui::GetColorU32(ImGuiCol_WindowBg, 0.6f));
  ImFont* title = model.ui.fonts.title != nullptr ? model.ui.fonts.title : ImGui::GetFont();
  const char* text = "Paused: Space continues";
  const ImVec2 size = title->CalcTextSizeA(title->FontSize, rect.size_px.x, 0.0f, text);
  draw->AddText(title, title->FontSize,
                {0.5f * (low.x + high.x - size.x), 0.5f * (low.y + high.y - size.y)},
                ImGui::GetColorU32(ImGuiCol_Text), text);
}

}  // namespace clay::studio
