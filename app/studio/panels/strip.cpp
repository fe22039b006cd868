// The strip at the left edge: tools and views as icons. Each runs a command of the table.

#include "app/studio/commands.hpp"
#include "app/studio/panels/panels.hpp"

#include <array>
#include <cmath>
#include <string>

namespace clay::studio {
namespace {

constexpr float kStripEm = 3.9f, kButtonEm = 3.05f, kIconEm = 1.5f;

/// Draws into a square: places are from 0 to 1.
struct Pen {
  ImDrawList* draw;
  ImVec2 corner;
  float size;
  ImU32 ink;
  [[nodiscard]] ImVec2 at(float x, float y) const {
    return {corner.x + size * x, corner.y + size * y};
  }
  void line(float ax, float ay, float bx, float by, float width = 0.09f) const {
    draw->AddLine(at(ax, ay), at(bx, by), ink, width * size);
  }
  void ball(float x, float y, float radius) const {
    draw->AddCircleFilled(at(x, y), radius * size, ink);
  }
  void ring(float x, float y, float radius) const {
    draw->AddCircle(at(x, y), radius * size, ink, 0, 0.09f * size);
  }
};

void press_icon(const Pen& pen) {
  pen.ball(0.3f, 0.5f, 0.24f);
  pen.line(0.66f, 0.05f, 0.66f, 0.95f, 0.16f);
  pen.line(0.86f, 0.05f, 0.86f, 0.95f);
}
void pinch_icon(const Pen& pen) {
  pen.ball(0.18f, 0.6f, 0.18f);
  pen.ball(0.82f, 0.6f, 0.18f);
  pen.line(0.5f, 0.05f, 0.5f, 0.95f, 0.16f);
}
void smooth_icon(const Pen& pen) {
  for (const float y : {0.3f, 0.55f, 0.8f}) {
    pen.draw->PathLineTo(pen.at(0.05f, y));
    pen.draw->PathBezierCubicCurveTo(pen.at(0.35f, y - 0.32f), pen.at(0.65f, y + 0.32f),
                                     pen.at(0.95f, y));
    pen.draw->PathStroke(pen.ink, ImDrawFlags_None, 0.09f * pen.size);
  }
}
void trim_icon(const Pen& pen) {
  pen.line(0.05f, 0.95f, 0.5f, 0.5f, 0.12f);
  pen.draw->AddTriangle(pen.at(0.42f, 0.42f), pen.at(0.95f, 0.3f), pen.at(0.7f, 0.05f), pen.ink,
                        0.1f * pen.size);
}
void needle_icon(const Pen& pen) {
  pen.line(0.02f, 0.35f, 0.98f, 0.35f, 0.06f);
  pen.line(0.02f, 0.35f, 0.36f, 0.35f, 0.2f);
  pen.line(0.55f, 0.5f, 0.55f, 0.98f, 0.12f);
  pen.line(0.85f, 0.5f, 0.85f, 0.98f, 0.12f);
}
void wire_icon(const Pen& pen) {
  pen.line(0.1f, 0.8f, 0.9f, 0.8f, 0.06f);
  pen.line(0.08f, 0.62f, 0.08f, 0.98f, 0.16f);
  pen.line(0.92f, 0.62f, 0.92f, 0.98f, 0.16f);
  pen.line(0.3f, 0.1f, 0.3f, 0.66f, 0.12f);
  pen.line(0.7f, 0.1f, 0.7f, 0.66f, 0.12f);
}
void foot_icon(const Pen& pen) {
  pen.line(0.08f, 0.95f, 0.3f, 0.2f);
  pen.line(0.92f, 0.95f, 0.7f, 0.2f);
  pen.line(0.3f, 0.2f, 0.7f, 0.2f, 0.16f);
  pen.line(0.0f, 0.95f, 1.0f, 0.95f);
}
void cut_icon(const Pen& pen) {
  pen.line(0.12f, 0.1f, 0.12f, 0.9f, 0.14f);
  pen.line(0.88f, 0.1f, 0.88f, 0.9f, 0.14f);
  pen.line(0.12f, 0.87f, 0.88f, 0.87f, 0.14f);
}
void panels_icon(const Pen& pen) {
  pen.draw->AddRect(pen.at(0.08f, 0.1f), pen.at(0.92f, 0.92f), pen.ink, 0.0f, 0, 0.09f * pen.size);
  pen.draw->AddRectFilled(pen.at(0.08f, 0.55f), pen.at(0.92f, 0.92f), pen.ink);
}
void walls_icon(const Pen& pen) {
  constexpr float kWidths[] = {0.06f, 0.12f, 0.2f};
  float y = 0.18f;
  for (const float width : kWidths) {
    pen.line(0.08f, y, 0.92f, y, width);
    y += 0.32f;
  }
}

struct Icon {
  std::string_view command;
  const char* label;
  void (*draw)(const Pen&);
};
constexpr std::array kIcons = {
    Icon{"tool.press", "Press", &press_icon},    Icon{"tool.pinch", "Pinch", &pinch_icon},
    Icon{"tool.smooth", "Smooth", &smooth_icon}, Icon{"tool.trim", "Trim", &trim_icon},
    Icon{"tool.needle", "Needle", &needle_icon}, Icon{"tool.wire", "Wire", &wire_icon},
    Icon{"tool.trim_foot", "Foot", &foot_icon},  Icon{"view.cut_half", "Inside", &cut_icon},
    Icon{"view.wall_map", "Walls", &walls_icon},
};
constexpr std::size_t kTools = 7;  // the rest are views

/// Returns whether the button was pressed. `tip` appears under the pointer.
bool icon_button(const char* label, void (*draw_icon)(const Pen&), bool enabled, bool on,
                 const std::string& tip, const ViewModel& model) {
  const Palette& colours = model.colours();
  const float em = ImGui::GetFontSize(), width = ImGui::GetContentRegionAvail().x;
  const ImVec2 at = ImGui::GetCursorScreenPos();
  ImGui::PushID(label);
  ImGui::PushStyleColor(ImGuiCol_Button, on ? ImGui::GetStyleColorVec4(ImGuiCol_ButtonActive)
                                            : ImVec4(0.0f, 0.0f, 0.0f, 0.0f));
  const bool pressed = ImGui::Button("##icon", {width, kButtonEm * em});
  mark_chosen(label, on);
  ImGui::PopStyleColor();
  ImGui::PopID();
  if (ImGui::IsItemHovered() && !model.fingers) ImGui::SetTooltip("%s", tip.c_str());
  const ImU32 ink =
      ImGui::GetColorU32(enabled ? ImGui::GetStyleColorVec4(ImGuiCol_Text)
                                 : ImVec4(colours.faint.x, colours.faint.y, colours.faint.z, 0.5f));
  ImDrawList* draw = ImGui::GetWindowDrawList();
  const float size = kIconEm * em;
  draw_icon({draw, {std::round(at.x + 0.5f * (width - size)), at.y + 0.35f * em}, size, ink});
  if (on)
    draw->AddRectFilled({at.x, at.y + 0.3f * em},
                        {at.x + 0.2f * em, at.y + (kButtonEm - 0.3f) * em},
                        ImGui::GetColorU32(ImGuiCol_Text), 0.1f * em);
  ImFont* small = model.ui.fonts.small != nullptr ? model.ui.fonts.small : ImGui::GetFont();
  const ImVec2 text = small->CalcTextSizeA(small->FontSize, width * 2.0f, 0.0f, label);
  draw->AddText(small, small->FontSize,
                {std::round(at.x + 0.5f * (width - text.x)), at.y + 2.08f * em}, ink, label);
  return pressed && enabled;
}

void draw_command(const Icon& icon, const ViewModel& model, Actions& actions) {
  const Command& command = *find_command(icon.command);
  if (icon_button(icon.label, icon.draw, command.enabled(model), command.checked(model),
                  tip_of(command, model), model))
    actions.emplace_back(RunCommand{command.id});
}

}  // namespace

float strip_width() { return std::round(kStripEm * ImGui::GetFontSize()); }

void draw_strip(const ViewModel& model, Actions& actions, glm::vec2 corner_px, glm::vec2 size_px,
                bool panels) {
  const float em = ImGui::GetFontSize();
  ImGui::SetNextWindowPos({corner_px.x, corner_px.y});
  ImGui::SetNextWindowSize({size_px.x, size_px.y});
  ImGui::PushStyleVar(ImGuiStyleVar_WindowPadding, ImVec2(0.3f * em, 0.3f * em));
  ImGui::PushStyleVar(ImGuiStyleVar_ItemSpacing, ImVec2(0.0f, 0.15f * em));
  ImGui::PushStyleVar(ImGuiStyleVar_ScrollbarSize, 0.3f * em);
  begin_window("##strip", ImGuiWindowFlags_NoTitleBar | ImGuiWindowFlags_NoResize |
                              ImGuiWindowFlags_NoMove | ImGuiWindowFlags_NoCollapse |
                              ImGuiWindowFlags_NoSavedSettings |
                              ImGuiWindowFlags_NoBringToFrontOnFocus);
  ImGui::BeginDisabled(!model.ui.shows<NoDialog>());
  for (std::size_t i = 0; i < kIcons.size(); ++i) {
    if (i == kTools) {
      ImGui::Spacing();
      ImGui::Separator();
      ImGui::Spacing();
    }
    draw_command(kIcons[i], model, actions);
  }
  const bool below = below_open(model.settings), diagnostics = diagnostics_open(model.settings);
  if (panels && icon_button("Panels", &panels_icon, true, below || diagnostics,
                            "Panels below the view", model)) {
    // The diagnostics are in the place of the other panels.
    if (diagnostics)
      actions.emplace_back(ToggleDiagnostics{});
    else
      actions.emplace_back(FoldPanel{kBelow, !below});
  }
  ImGui::EndDisabled();
  ImGui::End();
  ImGui::PopStyleVar(3);
}

}  // namespace clay::studio
