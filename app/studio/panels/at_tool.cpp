// Over the view: figures at the tool, the pull of the hand, the floor to keep, and the veil of a
// pause.

#include "app/studio/panels/at_tool.hpp"

#include "app/studio/panels/panels.hpp"
#include "app/studio/panels/widgets.hpp"
#include "claystack/engine/plan.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <string>
#include <vector>

namespace clay::studio {
namespace {

constexpr double kHardPullMm = 15.0;  // way of the spring at which the hand pulls with its strength
constexpr double kSlackMm = 2.0;
constexpr double kFiguresMm = 20.0;  // a tool so near the clay has figures
constexpr float kGaugeEm = 1.3f;     // radius of the gauge of a pull

/// The clay between the foot and the bore at this radius; empty: no bore is above it.
std::optional<double> floor_at(const render::PotView& pot, double rho_mm) {
  const auto holds_clay = [rho_mm](const render::Row& row) {
    return static_cast<double>(row.inner_mm) <= rho_mm &&
           rho_mm < static_cast<double>(row.outer_mm);
  };
  const auto foot = std::ranges::find_if(pot.rows, holds_clay);
  const auto bore = std::find_if_not(foot, pot.rows.end(), holds_clay);
  if (bore == pot.rows.end() || rho_mm >= static_cast<double>(bore->outer_mm)) return std::nullopt;
  return pot.height_mm * static_cast<double>(bore - foot) / static_cast<double>(pot.rows.size());
}

/// The wall that the check has measured, across the clay; before the first check, the level one.
double wall_mm(const ViewModel& model, const render::Row& row, double y_mm) {
  const auto& check = model.readings.check();
  const auto measured = check ? wall_mm_at(*check, y_mm) : std::nullopt;
  return measured.value_or(static_cast<double>(row.outer_mm - row.inner_mm));
}

/// Of a pot upside down: its foot is on top.
std::vector<std::string> figures_at_foot(const ViewModel& model, const render::ToolView& tool) {
  const LengthUnit unit = model.settings.unit;
  const render::PotView& pot = model.stroke.view();
  const double rho = std::hypot(tool.place_mm.x, tool.place_mm.z);
  const double from_foot_mm = pot.height_mm - tool.place_mm.y;
  std::vector<std::string> lines;
  if (const auto floor = floor_at(pot, rho))
    lines.push_back("floor " + thickness_text(*floor, unit));
  lines.push_back("radius " + length_text(rho, unit));
  lines.push_back((from_foot_mm < 0.0 ? "above the foot " : "from the foot ") +
                  length_text(std::abs(from_foot_mm), unit));
  return lines;
}

std::vector<std::string> figures_upright(const ViewModel& model, const render::ToolView& tool) {
  const LengthUnit unit = model.settings.unit;
  const render::PotView& pot = model.stroke.view();
  const double rho = std::hypot(tool.place_mm.x, tool.place_mm.z);
  std::vector<std::string> lines;
  const render::Row* row = row_at(pot, tool.place_mm.y);
  if (row != nullptr && static_cast<double>(row->inner_mm) > render::kBoreMm)
    lines.push_back("wall " + thickness_text(wall_mm(model, *row, tool.place_mm.y), unit));
  if (const auto floor = render::floor_of(pot); floor && tool.inside)
    lines.push_back("floor " + thickness_text(floor->thickness_mm(), unit));
  lines.push_back(fmt::format("radius {}", length_text(rho, unit)));
  lines.push_back(fmt::format("height {}", length_text(tool.place_mm.y, unit)));
  const ToolMode mode = model.tool_in_use().mode;
  if (cuts_level(mode) && row != nullptr)
    lines.push_back(fmt::format(
        "cuts off {}",
        length_text(mode == ToolMode::needle ? pot.height_mm - tool.place_mm.y : tool.place_mm.y,
                    unit)));
  if (const auto& strength = model.scene.strength(); strength && model.stroke.throwing())
    lines.push_back(fmt::format("strength {:.0f} %", 100.0 * *strength));
  return lines;
}

/// The pixels that the tool takes, or both tools of a pinch, and the gauge around them.
Span span_of(const ViewModel& model, const render::ToolView& tool, float at_px) {
  float widest_mm = 0.0f;
  for (const glm::vec2& p : tool.half_profile_mm) widest_mm = std::max(widest_mm, p.x);
  if (tool.gap_mm) widest_mm = 2.0f * widest_mm + 0.5f * static_cast<float>(*tool.gap_mm);
  const float reach =
      std::max(kGaugeEm * ImGui::GetFontSize(), widest_mm * model.scene.px_per_mm());
  return {at_px - reach, at_px + reach};
}

/// The pixels that the pot takes beside a box of this height around the tool.
Span span_of_pot(const ViewModel& model, double y_mm, float height_px) {
  const render::PotView& pot = model.stroke.view();
  const double reach_mm = static_cast<double>(height_px / model.scene.px_per_mm());
  const bool turned = model.upside_down();
  float widest_mm = 0.0f;
  for (double at = y_mm - reach_mm; at <= y_mm + reach_mm; at += 1.0)
    if (const render::Row* row = row_at(pot, turned ? pot.height_mm - at : at))
      widest_mm = std::max(widest_mm, row->outer_mm);
  const float axis = model.scene.pixel_of({0.0, y_mm}).value_or(glm::vec2(0.0f)).x;
  const float reach = widest_mm * model.scene.px_per_mm();
  return {axis - reach, axis + reach};
}

/// Beside the tool, and beside the pot if there is room; above `bottom_px`.
void draw_lines(const ViewModel& model, ImDrawList* draw, const std::vector<std::string>& lines,
                const render::ToolView& tool, glm::vec2 tool_px, const ViewRect& rect,
                float bottom_px) {
  const float em = ImGui::GetFontSize();
  float width = 0.0f;
  for (const std::string& line : lines)
    width = std::max(width, ImGui::CalcTextSize(line.c_str()).x);
  const float height = 1.25f * em * static_cast<float>(lines.size());
  const Span view{rect.corner_px.x, rect.corner_px.x + rect.size_px.x};
  ImVec2 at(place_beside(span_of(model, tool, tool_px.x),
                         span_of_pot(model, tool.place_mm.y, height), view, width, em),
            place_within(tool_px.y - 2.0f * em, {rect.corner_px.y, bottom_px}, height, 0.5f * em));
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
  draw->PathArcTo({tool_px.x, tool_px.y}, (kGaugeEm - 0.2f) * em, kTop, kTop + part * kTurn, 32);
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

std::vector<std::string> figures_at(const ViewModel& model, const render::ToolView& tool) {
  return model.upside_down() ? figures_at_foot(model, tool) : figures_upright(model, tool);
}

void draw_at_tool(const ViewModel& model, const ViewRect& rect, float bottom_px) {
  if (!model.document.has_work() || !model.ui.shows<NoDialog>()) return;
  if (model.readings.fallen()) return;
  const auto tool = model.scene.tool_view(model);
  if (!tool) return;
  const double rho = std::hypot(tool->place_mm.x, tool->place_mm.z);
  const auto place = render::pixel_of(model.scene.camera(), model.scene.viewport(), tool->place_mm);
  if (!place) return;
  const glm::vec2 at = glm::vec2(*place) + rect.corner_px;
  ImDrawList* draw = ImGui::GetBackgroundDrawList();
  draw->PushClipRect({rect.corner_px.x, rect.corner_px.y},
                     {rect.corner_px.x + rect.size_px.x, rect.corner_px.y + rect.size_px.y});
  const bool turned = model.upside_down();
  const render::PotView& pot = model.stroke.view();
  const render::Row* row =
      row_at(pot, turned ? pot.height_mm - tool->place_mm.y : tool->place_mm.y);
  const double widest = row != nullptr ? static_cast<double>(row->outer_mm) : 0.0;
  const bool near = model.stroke.throwing() || rho < widest + kFiguresMm;
  if (near && !turned && (tool->inside || rho < render::kBoreMm + 20.0))
    draw_floor(model, draw, rect.corner_px.x);
  if (cuts_level(model.tool_in_use().mode)) draw_cut_level(model, draw, tool->place_mm.y, widest);
  draw_pull(model, draw, at);
  if (near) draw_lines(model, draw, figures_at(model, *tool), *tool, at, rect, bottom_px);
  draw->PopClipRect();
}

void draw_pause(const ViewModel& model, const ViewRect& rect) {
  if (!model.stroke.paused() || !model.document.has_work() || !model.ui.shows<NoDialog>()) return;
  ImDrawList* draw = ImGui::GetBackgroundDrawList();
  const ImVec2 low(rect.corner_px.x, rect.corner_px.y);
  const ImVec2 high(low.x + rect.size_px.x, low.y + rect.size_px.y);
  draw->AddRectFilled(low, high, ImGui::GetColorU32(ImGuiCol_WindowBg, 0.6f));
  ImFont* title = model.ui.fonts.title != nullptr ? model.ui.fonts.title : ImGui::GetFont();
  const char* text = model.fingers ? "Paused\nWheel > Pause continues" : "Paused: Space continues";
  const ImVec2 size = title->CalcTextSizeA(title->FontSize, rect.size_px.x, 0.0f, text);
  draw->AddText(title, title->FontSize,
                {0.5f * (low.x + high.x - size.x), 0.5f * (low.y + high.y - size.y)},
                ImGui::GetColorU32(ImGuiCol_Text), text);
}

}  // namespace clay::studio
