// The lines at the top of the view: the verdict on the pot, its goal and its target.

#include "app/studio/panels/panels.hpp"
#include "app/studio/panels/widgets.hpp"

#include <fmt/format.h>

#include <string>

namespace clay::studio {
namespace {

/// A line over the top of the view, with a dot of this colour. Returns its lower edge.
float draw_pill(const std::string& words, const ImVec4& colour, const ViewRect& rect, float top) {
  const float em = ImGui::GetFontSize();
  const std::string text = wrapped(words, rect.size_px.x - 4.0f * em);
  const ImVec2 size = ImGui::CalcTextSize(text.c_str());
  const ImVec2 at(rect.corner_px.x + 0.5f * (rect.size_px.x - size.x) + 0.5f * em,
                  top + 0.35f * em);
  ImDrawList* draw = ImGui::GetBackgroundDrawList();
  const ImVec2 low(at.x - 1.7f * em, at.y - 0.35f * em);
  const ImVec2 high(at.x + size.x + 0.8f * em, at.y + size.y + 0.35f * em);
  draw->AddRectFilled(low, high, ImGui::GetColorU32(ImGuiCol_PopupBg, 0.92f), 0.9f * em);
  draw->AddCircleFilled({at.x - 0.85f * em, at.y + 0.5f * em}, 0.32f * em,
                        ImGui::GetColorU32(colour));
  draw->AddText(at, ImGui::GetColorU32(ImGuiCol_Text), text.c_str());
  return high.y;
}

/// The colours of a traffic light; none for clay that is no pot yet.
const ImVec4& colour_of(Verdict verdict, const Palette& colours) {
  switch (verdict) {
    case Verdict::ready:
      return colours.good;
    case Verdict::doubtful:
      return colours.warning;
    case Verdict::lump:
      return colours.faint;
    case Verdict::not_ready:
      break;
  }
  return colours.fault;
}

}  // namespace

std::string verdict_text(const Document& document, const Readings& readings, LengthUnit unit) {
  if (!readings.check() || !document.has_work()) return {};
  if (!readings.fallen()) return ready_text(*readings.check(), unit);
  return document.can_undo() ? "Fallen: undo removes the last stroke"
                             : "Fallen: no stroke is possible, but it can be exported";
}

float draw_verdict(const ViewModel& model, const ViewRect& rect) {
  const auto& check = model.readings.check();
  const std::string text = verdict_text(model.document, model.readings, model.settings.unit);
  if (text.empty() || !model.ui.shows<NoDialog>()) return rect.corner_px.y;
  const bool fallen = model.readings.fallen();
  const Palette& colours = model.colours();
  const float em = ImGui::GetFontSize();
  const Verdict verdict = fallen ? Verdict::not_ready : check->verdict();
  float top = draw_pill(text, colour_of(verdict, colours), rect, rect.corner_px.y + 0.45f * em);
  if (fallen) return top;
  if (check->maker && model.settings.goal.set()) {
    const GoalReading goal = read_goal(model.settings.goal, *check->maker, model.settings.unit);
    top = draw_pill(goal.text, goal.met ? colours.good : colours.warning, rect, top + 0.2f * em);
  }
  if (check->off && model.ui.target)
    top = draw_pill(fmt::format("Up to {} from the target, at a height of {}",
                                length_text(check->off->mm, model.settings.unit),
                                length_text(check->off->height_mm, model.settings.unit)),
                    match_colour(check->off->mm, colours), rect, top + 0.2f * em);
  return top;
}

}  // namespace clay::studio
