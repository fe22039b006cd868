// Along the edges of the view: status, banner, hint.

#include "app/studio/panels/panels.hpp"
#include "app/studio/panels/widgets.hpp"

#include <fmt/format.h>

#include <cmath>

namespace clay::studio {
namespace {

constexpr ImGuiWindowFlags kBar = ImGuiWindowFlags_NoTitleBar | ImGuiWindowFlags_NoResize |
                                  ImGuiWindowFlags_NoMove | ImGuiWindowFlags_NoScrollbar |
                                  ImGuiWindowFlags_NoCollapse | ImGuiWindowFlags_NoSavedSettings;

void part(const std::string& text, const ImVec4& colour, bool last = false) {
  ImGui::TextColored(colour, "%s", text.c_str());
  if (!last) ImGui::SameLine(0.0f, 1.6f * ImGui::GetFontSize());
}

std::string words_of_work(const AppState& shop) {
  if (!shop.potter.has_work()) return "No clay on the wheel";
  const std::string name =
      shop.file.empty() ? shop.potter.scene().name : shop.file.filename().string();
  return name + (shop.potter.unsaved() ? " \xe2\x80\xa2 not saved" : "");
}

ImVec4 colour_of(Grade grade, const Palette& colours) {
  return grade == Grade::note      ? colours.accent
         : grade == Grade::warning ? colours.warning
                                   : colours.fault;
}

}  // namespace

float status_height() { return std::round(1.75f * ImGui::GetFontSize()); }

void draw_status_bar(AppState& shop, glm::vec2 corner_px, glm::vec2 size_px) {
  ImGui::SetNextWindowPos({corner_px.x, corner_px.y});
  ImGui::SetNextWindowSize({size_px.x, size_px.y});
  ImGui::PushStyleVar(ImGuiStyleVar_WindowPadding,
                      ImVec2(ImGui::GetStyle().WindowPadding.x, 0.3f * ImGui::GetFontSize()));
  ImGui::PushStyleVar(ImGuiStyleVar_WindowMinSize, ImVec2(1.0f, 1.0f));
  ImGui::PushStyleColor(ImGuiCol_WindowBg, ImGui::GetStyleColorVec4(ImGuiCol_MenuBarBg));
  ImGui::Begin("##status", nullptr, kBar);
  const Palette& colours = shop.colours();
  const ImVec4 text = ImGui::GetStyleColorVec4(ImGuiCol_Text);
  part(words_of_work(shop), text);
  part(shop.potter.device_name(), text);
  const servo::LiveStatus& status = shop.potter.status();
  if (shop.potter.throwing())
    part(fmt::format("{:.0f} Hz", shop.potter.tick_rate_hz()), text);
  else
    part("at rest", colours.faint);
  part(fmt::format("{} missed", status.missed),
       status.missed > 0 ? colours.warning : colours.faint);
  if (shop.potter.has_work())
    part(fmt::format("volume error {:.0f} quanta", std::abs(status.volume_error)),
         status.volume_error != 0.0 ? colours.fault : colours.good);
  const std::string hand = words_of_hand(shop);
  part(hand.empty() && shop.potter.paused() ? "paused" : hand,
       shop.potter.paused() || waits_for_rearm(shop) ? colours.warning : text, true);
  ImGui::End();
  ImGui::PopStyleColor();
  ImGui::PopStyleVar(2);
}

void draw_banner(AppState& shop, const ViewRect& view) {
  shop.notices.forget_old(1e-9 * static_cast<double>(shop.host.frame_ns()));
  const auto& notice = shop.notices.shown();
  if (!notice) return;
  // What is only good to know does not lie over a card.
  if (notice->grade == Grade::note && shop.overlay != Overlay::none) return;
  const float pad = ImGui::GetFontSize();
  const float width = std::min(view.size_px.x - 2.0f * pad, 40.0f * ImGui::GetFontSize());
  ImGui::SetNextWindowPos(
      {view.corner_px.x + 0.5f * (view.size_px.x - width), view.corner_px.y + pad});
  ImGui::SetNextWindowSize({width, 0.0f});
  ImGui::PushStyleVar(ImGuiStyleVar_WindowRounding, 0.4f * pad);
  ImGui::PushStyleVar(ImGuiStyleVar_WindowBorderSize, 1.0f);
  ImGui::PushStyleColor(ImGuiCol_WindowBg, ImGui::GetStyleColorVec4(ImGuiCol_PopupBg));
  const ImVec4 colour = colour_of(notice->grade, shop.colours());
  ImGui::PushStyleColor(ImGuiCol_Border, colour);
  ImGui::Begin("##banner", nullptr,
               kBar | ImGuiWindowFlags_AlwaysAutoResize | ImGuiWindowFlags_NoFocusOnAppearing);
  const char* grade = notice->grade == Grade::note      ? "Note"
                      : notice->grade == Grade::warning ? "Warning"
                                                        : "Fault";
  ImGui::TextColored(colour, "%s", grade);
  ImGui::SameLine(ImGui::GetContentRegionMax().x - ImGui::CalcTextSize("Close").x -
                  2.0f * ImGui::GetStyle().FramePadding.x);
  const bool closed = ImGui::Button("Close");
  ImGui::TextWrapped("%s", notice->text.c_str());
  ImGui::End();
  ImGui::PopStyleColor(2);
  ImGui::PopStyleVar(2);
  if (closed) shop.notices.close();
}

void draw_hint(AppState& shop, const ViewRect& view) {
  if (!shop.settings.hints || shop.overlay != Overlay::none || shop.potter.throwing()) return;
  const char* text =
      "Hold the left button on the clay and drag to shape it.  Middle or right button turns the "
      "view, the wheel zooms.  Press ? for all keys.";
  const float pad = ImGui::GetFontSize();
  const float width = std::min(view.size_px.x - 2.0f * pad, 36.0f * pad);
  ImGui::SetNextWindowPos(
      {view.corner_px.x + 0.5f * (view.size_px.x - width), view.corner_px.y + view.size_px.y - pad},
      ImGuiCond_Always, {0.0f, 1.0f});
  ImGui::SetNextWindowSize({width, 0.0f});
  ImGui::PushStyleVar(ImGuiStyleVar_WindowRounding, 0.4f * pad);
  ImGui::PushStyleColor(ImGuiCol_WindowBg, ImGui::GetStyleColorVec4(ImGuiCol_PopupBg));
  ImGui::Begin("##hint", nullptr,
               kBar | ImGuiWindowFlags_AlwaysAutoResize | ImGuiWindowFlags_NoFocusOnAppearing);
  ImGui::TextWrapped("%s", text);
  if (ImGui::Button("Do not show this again")) shop.settings.hints = false;
  ImGui::End();
  ImGui::PopStyleColor();
  ImGui::PopStyleVar();
}

}  // namespace clay::studio
