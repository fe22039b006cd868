// The section of the pot with its dimensions, at the resolution of the screen.

#include "app/render/legend.hpp"
#include "app/render/pot_view.hpp"
#include "app/studio/panels/panels.hpp"
#include "app/studio/panels/plot.hpp"
#include "app/studio/panels/widgets.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>
#include <vector>

namespace clay::studio {
namespace {

constexpr float kLeastHeightEm = 8.0f, kUsualHeightEm = 11.0f;
constexpr std::array kParts = {"Half", "Full"};

/// From the profile's plane (rho, y) [mm] to pixels.
struct Sheet {
  ImVec2 foot;  ///< position of the foot of the axis
  float px_per_mm = 1.0f;
  std::optional<double> turned_mm = {};  ///< the height of a pot that is shown upside down
  [[nodiscard]] double turned(double y_mm) const { return turned_mm ? *turned_mm - y_mm : y_mm; }
  [[nodiscard]] ImVec2 at(double rho_mm, double y_mm) const {
    y_mm = turned(y_mm);
    return {foot.x + px_per_mm * static_cast<float>(rho_mm),
            foot.y - px_per_mm * static_cast<float>(y_mm)};
  }
};

/// Reserves space for the dimensions: height above and at the left, width below.
Sheet sheet_for(const PlotArea& area, double widest, double height, bool full) {
  const float em = ImGui::GetFontSize();
  const ImVec2 low(area.low.x + 1.4f * em, area.low.y + 1.6f * em);
  const ImVec2 high(area.high.x - 0.8f * em, area.high.y - 2.0f * em);
  const double wide = full ? 2.0 * widest : widest;
  Sheet sheet;
  sheet.px_per_mm = static_cast<float>(std::min(static_cast<double>(high.x - low.x) / wide,
                                                static_cast<double>(high.y - low.y) / height));
  const float width = sheet.px_per_mm * static_cast<float>(wide);
  const float left = 0.5f * (low.x + high.x - width);
  sheet.foot = {full ? left + 0.5f * width : left, high.y};
  return sheet;
}

ImU32 colour_at(const PotCheck* check, double y_mm, const ImVec4& clay) {
  if (check == nullptr || !check->proved) return ImGui::GetColorU32(clay);
  const double unknown = std::numeric_limits<double>::infinity();
  const render::Swatch swatch =
      render::wall_swatch(wall_map_of(*check), wall_mm_at(*check, y_mm).value_or(unknown));
  return IM_COL32(swatch.red, swatch.green, swatch.blue, 255);
}

/// Colour for the distance of a row from the target.
ImU32 match_at(const OffTarget& off, double part, const Palette& colours) {
  const double rows = static_cast<double>(off.rows_mm.size());
  const double mm = static_cast<double>(
      off.rows_mm[static_cast<std::size_t>(std::clamp(part * rows, 0.0, rows - 1.0))]);
  return ImGui::GetColorU32(match_colour(mm, colours));
}

/// Opaque where all rings of a row hold clay, faint where only some do.
void draw_clay(const ViewModel& model, const Sheet& sheet, double height, bool full,
               const PotCheck* check, const OffTarget* off) {
  const std::size_t rows = whole_px(sheet.px_per_mm * static_cast<float>(height));
  const auto& section = model.readings.section(rows);
  ImDrawList* draw = ImGui::GetWindowDrawList();
  const double row_mm = height / static_cast<double>(rows);
  for (std::size_t i = 0; i < section.size(); ++i) {
    const SectionRow& row = section[i];
    const double low = row_mm * static_cast<double>(i), high = low + row_mm;
    const ImU32 solid = off != nullptr && check == nullptr
                            ? match_at(*off, (low + 0.5 * row_mm) / height, model.colours())
                            : colour_at(check, low + 0.5 * row_mm, model.colours().clay);
    const ImU32 faint = (solid & ~IM_COL32_A_MASK) | IM_COL32(0, 0, 0, 90);
    const auto stretch = [&](float inner, float outer, ImU32 colour) {
      if (!(outer > inner)) return;
      draw->AddRectFilled(sheet.at(inner, high), sheet.at(outer, low), colour);
      if (full) draw->AddRectFilled(sheet.at(-outer, high), sheet.at(-inner, low), colour);
    };
    if (row.inner_least_mm < row.inner_most_mm || row.outer_least_mm < row.outer_most_mm)
      stretch(row.inner_least_mm, row.outer_most_mm, faint);
    stretch(row.inner_most_mm, row.outer_least_mm, solid);
  }
}

/// Dimension lines with their values. `diameter`: the value of the width.
void draw_measures(const PlotArea& area, const Sheet& sheet, double widest, double height,
                   double diameter, bool full, const Palette& colours, LengthUnit unit) {
  ImDrawList* draw = ImGui::GetWindowDrawList();
  const float em = ImGui::GetFontSize(), tick = 0.25f * em;
  const ImU32 ink = ImGui::GetColorU32(colours.faint);
  const float x = area.low.x + 0.6f * em;
  const ImVec2 top = sheet.at(0.0, height);
  draw->AddLine({x, sheet.foot.y}, {x, top.y}, ink);
  for (const float y : {sheet.foot.y, top.y}) draw->AddLine({x - tick, y}, {x + tick, y}, ink);
  draw->AddText({area.low.x + 0.3f * em, top.y - 1.3f * em}, ink,
                length_text(height, unit).c_str());
  const float y = sheet.foot.y + 0.5f * em;
  const ImVec2 left = sheet.at(full ? -widest : 0.0, 0.0), right = sheet.at(widest, 0.0);
  draw->AddLine({left.x, y}, {right.x, y}, ink);
  for (const float end : {left.x, right.x}) draw->AddLine({end, y - tick}, {end, y + tick}, ink);
  const std::string text =
      full ? length_text(diameter, unit) : "r " + length_text(0.5 * diameter, unit);
  const float text_width = ImGui::CalcTextSize(text.c_str()).x;
  draw->AddText({std::clamp(0.5f * (left.x + right.x - text_width), area.low.x + tick,
                            area.high.x - text_width - tick),
                 y + 0.2f * em},
                ink, text.c_str());
  draw->AddLine({area.low.x, sheet.foot.y}, {area.high.x, sheet.foot.y}, ink);
  draw->AddLine(sheet.at(0.0, 0.0), sheet.at(0.0, height), ink);
}

void draw_outline(const std::vector<glm::vec2>& half_profile, const Sheet& sheet,
                  glm::dvec2 place_mm, const ImVec4& colour) {
  std::vector<ImVec2> line;
  const auto add = [&](const glm::vec2& p, double side) {
    line.push_back(sheet.at(place_mm.x + side * static_cast<double>(p.x),
                            place_mm.y + static_cast<double>(p.y)));
  };
  for (const glm::vec2& p : half_profile) add(p, 1.0);
  for (std::size_t i = half_profile.size(); i-- > 0;) add(half_profile[i], -1.0);
  ImGui::GetWindowDrawList()->AddPolyline(line.data(), static_cast<int>(line.size()),
                                          ImGui::GetColorU32(colour), ImDrawFlags_Closed,
                                          0.12f * ImGui::GetFontSize());
}

void draw_tool_at(const render::ToolView& tool, const Sheet& sheet, const Palette& colours) {
  const glm::dvec2 place(std::hypot(tool.place_mm.x, tool.place_mm.z), tool.place_mm.y);
  const ImVec4 colour = tool.contact ? colours.accent : ImGui::GetStyleColorVec4(ImGuiCol_Text);
  if (!tool.gap_mm) return draw_outline(tool.half_profile_mm, sheet, place, colour);
  float widest = 0.0f;
  for (const glm::vec2& p : tool.half_profile_mm) widest = std::max(widest, p.x);
  const glm::dvec2 reach(0.5 * *tool.gap_mm + static_cast<double>(widest), 0.0);
  draw_outline(tool.half_profile_mm, sheet, place + reach, colour);
  draw_outline(tool.half_profile_mm, sheet, place - reach, colour);
}

/// The outline of the target, outer and inner wall on each side.
void draw_target_outline(const render::PotView& target, const Sheet& sheet, bool full) {
  const ImU32 ink = ImGui::GetColorU32(ImGuiCol_Text);
  const double row_mm = target.height_mm / static_cast<double>(target.rows.size());
  std::vector<ImVec2> line;
  const auto wall = [&](double side, float render::Row::*radius) {
    line.clear();
    for (std::size_t i = 0; i < target.rows.size(); ++i)
      line.push_back(sheet.at(side * static_cast<double>(target.rows[i].*radius),
                              row_mm * (static_cast<double>(i) + 0.5)));
    ImGui::GetWindowDrawList()->AddPolyline(line.data(), static_cast<int>(line.size()), ink,
                                            ImDrawFlags_None, 0.1f * ImGui::GetFontSize());
  };
  for (const double side : {1.0, -1.0}) {
    if (side < 0.0 && !full) continue;
    wall(side, &render::Row::outer_mm);
    wall(side, &render::Row::inner_mm);
  }
}

/// Marks the thinnest place, walls that are too thin, and places without a proof.
void draw_faults(const PlotArea& area, const Sheet& sheet, const PotCheck& check,
                 const Palette& colours) {
  ImDrawList* draw = ImGui::GetWindowDrawList();
  const float em = ImGui::GetFontSize();
  if (check.fault_mm) {
    const float y = sheet.at(0.0, *check.fault_mm).y;
    draw->AddLine({area.low.x, y}, {area.high.x, y}, ImGui::GetColorU32(colours.fault), 0.15f * em);
  }
  if (!check.proved) return;
  for (const Stretch& thin : thin_stretches(check))
    draw->AddRectFilled({area.high.x - 0.4f * em, sheet.at(0.0, thin.to_mm).y},
                        {area.high.x - 0.15f * em, sheet.at(0.0, thin.from_mm).y},
                        ImGui::GetColorU32(colours.fault));
  const ImVec2 from = sheet.at(std::abs(check.thinnest_from.x), check.thinnest_from.y);
  const ImVec2 to = sheet.at(std::abs(check.thinnest_to.x), check.thinnest_to.y);
  const ImU32 ink =
      ImGui::GetColorU32(check.thin() ? colours.fault : ImGui::GetStyleColorVec4(ImGuiCol_Text));
  draw->AddLine(from, to, ink, 0.12f * em);
  for (const ImVec2& end : {from, to}) draw->AddCircleFilled(end, 0.18f * em, ink);
}

/// Values at the pointer, beside it. Heights of a pot upside down are those from its foot.
void read_out(const PlotArea& area, const Sheet& sheet, bool full, const PotCheck* check,
              LengthUnit unit) {
  if (!ImGui::IsWindowHovered() || !ImGui::IsMouseHoveringRect(area.low, area.high)) return;
  const ImVec2 mouse = ImGui::GetMousePos();
  const double rho = static_cast<double>((mouse.x - sheet.foot.x) / sheet.px_per_mm);
  const double up = static_cast<double>((sheet.foot.y - mouse.y) / sheet.px_per_mm);
  const double y = sheet.turned(up);
  if (up < 0.0 || (!full && rho < 0.0)) return;
  ImDrawList* draw = ImGui::GetWindowDrawList();
  const ImU32 ink = ImGui::GetColorU32(ImGuiCol_Text, 0.5f);
  draw->AddLine({area.low.x, mouse.y}, {area.high.x, mouse.y}, ink);
  draw->AddLine({mouse.x, area.low.y}, {mouse.x, area.high.y}, ink);
  std::string text =
      fmt::format("Radius {}\n{} {}", length_text(std::abs(rho), unit),
                  sheet.turned_mm ? "From the foot" : "Height", length_text(y, unit));
  if (const auto wall = check != nullptr ? wall_mm_at(*check, y) : std::nullopt)
    text += "\nWall " + thickness_text(*wall, unit);
  ImGui::SetTooltip("%s", text.c_str());
}

/// The colours of `match_colour`.
void draw_match_legend(const Palette& colours, LengthUnit unit) {
  const auto part = [](const ImVec4& colour, const std::string& text, bool last) {
    ImGui::TextColored(colour, "%s", text.c_str());
    if (!last) ImGui::SameLine(0.0f, 0.8f * ImGui::GetFontSize());
  };
  part(colours.good, "within " + length_text(kMatchesMm, unit), false);
  part(colours.warning, length_text(kNearMm, unit), false);
  part(colours.fault, "farther", true);
}

/// The rest of the column, so that it scrolls only if it must; at most twice as high as wide. In a
/// low window the header of the panel below is reached by scrolling.
float plot_height_em(int lines) {
  const float em = ImGui::GetFontSize(), gap = ImGui::GetStyle().ItemSpacing.y;
  const float below = static_cast<float>(lines) * ImGui::GetTextLineHeightWithSpacing();
  const float header = ImGui::GetFrameHeightWithSpacing() + gap;
  float room_em = (ImGui::GetContentRegionAvail().y - below - 3.0f * gap) / em;
  if (room_em - header / em >= kUsualHeightEm) room_em -= header / em;
  const float most_em = 2.0f * ImGui::GetContentRegionAvail().x / em;
  return std::clamp(room_em, kLeastHeightEm, std::max(kLeastHeightEm, most_em));
}

}  // namespace

void draw_section(const ViewModel& model, Actions& actions) {
  const Palette& colours = model.colours();
  const bool full = model.settings.full_section;
  if (const int part = choice_row("part", kParts, full ? 1 : 0); part >= 0)
    actions.emplace_back(SetFullSection{part == 1});
  const PlotArea area =
      begin_plot(plot_height_em(model.readings.fallen() || model.ui.target ? 1 : 0));
  const ClayStack* stack = model.readings.stack();
  if (stack == nullptr || stack->size() == 0)
    return plot_text(area, Corner::upper_left, "No clay on the wheel", colours.faint);
  const double height = stack->height_mm(), widest = model.readings.widest_mm();
  const auto& known = model.readings.check();
  const PotCheck* check = known && !model.readings.fallen() ? &*known : nullptr;
  const Target* target = model.readings.fallen() ? nullptr : model.ui.target.get();
  const Sheet upright =
      target == nullptr
          ? sheet_for(area, widest, height, full)
          : sheet_for(area, std::max(widest, render::extent_of(target->view).radius_mm),
                      std::max(height, target->view.height_mm), full);
  const OffTarget* off =
      target != nullptr && check != nullptr && check->off ? &*check->off : nullptr;
  Sheet sheet = upright;
  if (model.upside_down()) sheet.turned_mm = height;
  ImDrawList* draw = ImGui::GetWindowDrawList();
  draw->PushClipRect(area.low, area.high, true);
  draw_clay(model, sheet, height, full, model.settings.wall_map ? check : nullptr, off);
  if (target != nullptr) draw_target_outline(target->view, sheet, full);
  draw_measures(area, upright, widest, height, model.readings.diameter_mm(), full, colours,
                model.settings.unit);
  if (check != nullptr) draw_faults(area, sheet, *check, colours);
  if (const auto tool = model.scene.tool_view(model)) draw_tool_at(*tool, upright, colours);
  read_out(area, sheet, full, check, model.settings.unit);
  draw->PopClipRect();
  if (off != nullptr && !model.settings.wall_map) draw_match_legend(colours, model.settings.unit);
  if (model.readings.fallen()) faint_text(colours, "Shown as it stood before the fall.");
}

}  // namespace clay::studio
