// The guide: a card with the present step, and the path to follow over the view.

#include "app/studio/commands.hpp"
#include "app/studio/fall_show.hpp"
#include "app/studio/panels/panels.hpp"
#include "app/studio/panels/widgets.hpp"

#include <fmt/format.h>
#include <imgui_internal.h>

#include <algorithm>
#include <cmath>
#include <optional>

namespace clay::studio {
namespace {

constexpr ImGuiWindowFlags kCard =
    ImGuiWindowFlags_NoTitleBar | ImGuiWindowFlags_NoResize | ImGuiWindowFlags_NoMove |
    ImGuiWindowFlags_NoScrollbar | ImGuiWindowFlags_NoCollapse | ImGuiWindowFlags_NoSavedSettings |
    ImGuiWindowFlags_AlwaysAutoResize | ImGuiWindowFlags_NoFocusOnAppearing;
constexpr const char* kCardId = "##guide";
constexpr float kCardEm = 30.0f, kDotEm = 0.9f;

/// The name in the header of the panel of the tool.
std::string text_of_tool(ToolMode mode) { return fmt::format("Tool: {}", name_of(mode)); }

/// One dot for each step. A full dot is a step that is done or in progress; a hollow one had no
/// stroke or comes later.
void draw_steps(const Guide& guide, const Palette& colours) {
  const float em = ImGui::GetFontSize(), radius = 0.22f * em;
  ImDrawList* draw = ImGui::GetWindowDrawList();
  const ImVec2 at = ImGui::GetCursorScreenPos();
  for (std::size_t i = 0; i < guide.steps(); ++i) {
    const ImVec2 middle(at.x + radius + static_cast<float>(i) * kDotEm * em, at.y + 0.5f * em);
    const ImVec4& colour = i < guide.step() ? colours.good : colours.accent;
    if (i <= guide.step() && !guide.skipped(i) && !guide.left_out(i))
      draw->AddCircleFilled(middle, radius, ImGui::GetColorU32(colour));
    else
      draw->AddCircle(middle, radius, ImGui::GetColorU32(colours.faint));
  }
  ImGui::Dummy({kDotEm * em * static_cast<float>(guide.steps()), em});
}

void draw_progress(double part, const Palette& colours) {
  ImGui::PushStyleColor(ImGuiCol_PlotHistogram, colours.good);
  ImGui::ProgressBar(static_cast<float>(part), {-1.0f, 0.35f * ImGui::GetFontSize()}, "");
  ImGui::PopStyleColor();
}

void draw_title(const ViewModel& model, const char* text) {
  ImGui::PushFont(model.ui.fonts.title);
  ImGui::TextUnformatted(text);
  ImGui::PopFont();
}

/// The steps just before the present one that needed no stroke; empty: none.
std::string left_out_text(const Guide& guide) {
  std::string names;
  for (std::size_t i = guide.step(); i > 0 && guide.left_out(i - 1); --i)
    names = guide.stroke(i - 1).name + (names.empty() ? "" : ", ") + names;
  return names.empty() ? names
                       : fmt::format("Left out, because the pot needs no change: {}", names);
}

void draw_present_step(const ViewModel& model, Actions& actions) {
  const Guide& guide = model.guide;
  const Palette& colours = model.colours();
  const strokes::Stroke& stroke = guide.stroke(guide.step());
  draw_title(model, stroke.name.c_str());
  if (const std::string left_out = left_out_text(guide); !left_out.empty())
    faint_text(colours, left_out);
  wrapped_text(stroke.hint);
  const LessonPlan* plan = guide.plan();
  if (plan != nullptr && !plan->problem.empty())
    ImGui::TextColored(colours.warning, "%s", plan->problem.c_str());
  draw_progress(guide.progress(), colours);
  if (guide.demonstration() != Demonstration::none) {
    if (ImGui::Button("Stop")) actions.emplace_back(StopShowing{});
    constexpr const char* kWatch = "Watch, or press on the clay to take over.";
    same_line_if_room(kWatch);
    faint_text(colours, kWatch);
    return;
  }
  const Command& show = *find_command("help.show_step");
  ImGui::BeginDisabled(!show.enabled(model));
  if (ImGui::Button("Show me")) actions.emplace_back(ShowStep{});
  ImGui::EndDisabled();
  if (ImGui::IsItemHovered(ImGuiHoveredFlags_AllowWhenDisabled))
    ImGui::SetTooltip("%s", tip_of(show, model).c_str());
  same_line_if_room("Next step");
  if (ImGui::Button("Next step")) actions.emplace_back(NextStep{});
  same_line_if_room("End the lesson");
  if (ImGui::Button("End the lesson")) actions.emplace_back(EndLesson{});
  if (plan == nullptr) return;
  const std::string tool = text_of_tool(plan->mode);
  same_line_if_room(tool.c_str());
  ImGui::TextColored(colours.faint, "%s", tool.c_str());
}

void draw_fallen(const ViewModel& model, Actions& actions) {
  draw_title(model, "The pot has fallen");
  ImGui::TextWrapped("Reason: %s. Undo the last stroke.",
                     fall_reason(*model.document.pot().collapse));
  const Command& undo = *find_command("edit.undo");
  if (main_button(undo.title, model.colours(), undo.enabled(model)))
    actions.emplace_back(RunCommand{undo.id});
  same_line_if_room("End the lesson");
  if (ImGui::Button("End the lesson")) actions.emplace_back(EndLesson{});
}

void draw_finish(const ViewModel& model, Actions& actions) {
  const Guide& guide = model.guide;
  const std::size_t skipped = guide.skipped_steps();
  draw_title(model, skipped == 0 ? "The pot is thrown" : "The last step is over");
  ImGui::TextWrapped(
      "%s", (skipped == 0 ? std::string()
                          : fmt::format("{} of {} steps were skipped. ", skipped, guide.steps()))
                .append("Export the pot for printing, or go on shaping it as you like.")
                .c_str());
  if (main_button("Export...", model.colours())) actions.emplace_back(RunCommand{"file.export"});
  const char* again = guide.shown() ? "Throw it yourself" : "Throw it again";
  same_line_if_room(again);
  if (ImGui::Button(again)) actions.emplace_back(YourTurn{});
  same_line_if_room("End the lesson");
  if (ImGui::Button("End the lesson")) actions.emplace_back(EndLesson{});
}

void draw_arrow(ImDrawList* draw, ImVec2 from, ImVec2 to, ImU32 colour, float size) {
  const ImVec2 way(to.x - from.x, to.y - from.y);
  const float length = std::hypot(way.x, way.y);
  if (length < 1e-3f) return;
  const ImVec2 ahead(size * way.x / length, size * way.y / length), side(-ahead.y, ahead.x);
  draw->AddTriangleFilled({to.x + ahead.x, to.y + ahead.y},
                          {to.x - ahead.x + 0.8f * side.x, to.y - ahead.y + 0.8f * side.y},
                          {to.x - ahead.x - 0.8f * side.x, to.y - ahead.y - 0.8f * side.y}, colour);
}

/// The distance of the tool from the path [mm].
double distance_mm(const LessonPlan& plan, const glm::dvec3& tool_mm) {
  const glm::dvec2 at(std::hypot(tool_mm.x, tool_mm.z), tool_mm.y);
  double least = 1e9;
  for (const PathPoint& point : plan.path)
    least = std::min(least, std::hypot(point.at_mm.x - at.x, point.at_mm.y - at.y));
  return least;
}

}  // namespace

float guide_height() {
  const ImGuiWindow* card = ImGui::FindWindowByName(kCardId);
  // In its first frame ImGui measures a window and does not show it.
  const bool settled = card != nullptr && card->WasActive && card->HiddenFramesCannotSkipItems <= 0;
  return settled ? card->Size.y + ImGui::GetFontSize() : 0.0f;
}

void draw_guide(const ViewModel& model, Actions& actions, const ViewRect& rect) {
  if (!model.guide.active() || !model.ui.shows<NoDialog>()) return;
  const float em = ImGui::GetFontSize();
  const float width = std::min(rect.size_px.x - 2.0f * em, kCardEm * em);
  ImGui::SetNextWindowPos(
      {rect.corner_px.x + 0.5f * rect.size_px.x, rect.corner_px.y + rect.size_px.y - em},
      ImGuiCond_Always, {0.5f, 1.0f});
  ImGui::SetNextWindowSize({width, 0.0f});
  ImGui::PushStyleVar(ImGuiStyleVar_WindowRounding, 0.6f * em);
  ImGui::PushStyleColor(ImGuiCol_WindowBg, ImGui::GetStyleColorVec4(ImGuiCol_PopupBg));
  begin_window(kCardId, kCard);
  const Guide& guide = model.guide;
  const std::string title = guide.finished() ? guide.title()
                                             : fmt::format("{}, step {} of {}", guide.title(),
                                                           guide.step() + 1, guide.steps());
  const float dots = kDotEm * em * static_cast<float>(guide.steps());
  if (dots + ImGui::CalcTextSize(title.c_str()).x + 2.0f * em < ImGui::GetContentRegionAvail().x) {
    draw_steps(guide, model.colours());
    ImGui::SameLine();
  }
  ImGui::TextColored(model.colours().faint, "%s", title.c_str());
  if (model.readings.fallen())
    draw_fallen(model, actions);
  else if (guide.finished())
    draw_finish(model, actions);
  else
    draw_present_step(model, actions);
  ImGui::End();
  ImGui::PopStyleColor();
  ImGui::PopStyleVar();
}

void draw_path(const ViewModel& model, const ViewRect& rect) {
  if (!model.guide.active() || !model.ui.shows<NoDialog>() || model.readings.fallen()) return;
  const LessonPlan* plan = model.guide.finished() ? nullptr : model.guide.plan();
  if (plan == nullptr || plan->path.size() < 2) return;
  std::vector<ImVec2> line;
  for (const PathPoint& point : plan->path)
    if (const auto at = model.scene.pixel_of(point.at_mm)) line.emplace_back(at->x, at->y);
  if (line.size() < 2) return;
  const float em = ImGui::GetFontSize();
  const bool throwing = model.stroke.by_hand() || model.stroke.touched();
  const bool off = throwing && model.stroke.status().ticks > 0 &&
                   distance_mm(*plan, model.stroke.status().tool_mm) > 2.0 * kPathToleranceMm;
  const ImVec4 colour = off ? model.colours().warning : model.colours().good;
  const auto ink = [&](float alpha) {
    return ImGui::GetColorU32(ImVec4(colour.x, colour.y, colour.z, alpha));
  };
  ImDrawList* draw = ImGui::GetBackgroundDrawList();
  draw->PushClipRect({rect.corner_px.x, rect.corner_px.y},
                     {rect.corner_px.x + rect.size_px.x, rect.corner_px.y + rect.size_px.y});
  const int count = static_cast<int>(line.size());
  const float band = 2.0f * static_cast<float>(kPathToleranceMm) * model.scene.px_per_mm();
  draw->AddPolyline(line.data(), count, ink(0.22f), ImDrawFlags_None, band);
  draw->AddPolyline(line.data(), count, ink(0.95f), ImDrawFlags_None, 0.16f * em);
  for (std::size_t i = 20; i + 4 < line.size(); i += 30)
    draw_arrow(draw, line[i - 1], line[i], ink(0.95f), 0.4f * em);
  draw->AddCircleFilled(line.front(), 0.5f * em, ink(1.0f));
  draw->AddCircleFilled(line.front(), 0.25f * em, ImGui::GetColorU32(ImGuiCol_WindowBg));
  draw_arrow(draw, line[line.size() - 2], line.back(), ink(1.0f), 0.55f * em);
  draw->PopClipRect();
}

}  // namespace clay::studio
