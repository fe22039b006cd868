#include "app/studio/panels/panels.hpp"

#include "app/studio/commands.hpp"
#include "app/studio/panels/widgets.hpp"

#include <fmt/format.h>
#include <imgui_internal.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <vector>

namespace clay::studio {
namespace {

struct Panel {
  const char* id;     ///< key in the settings
  const char* title;  ///< title of the header, which folds the panel
  Column column;
  bool open;  ///< default, if the settings do not contain the panel
  void (*draw)(const ViewModel& model, Actions& actions);
};
const std::array kPanels = {
    Panel{"tool", "Tool", Column::context, true, &draw_tool},
    Panel{"pot", "Pot", Column::context, true, &draw_pot},
    Panel{"walls", "Walls", Column::context, true, &draw_walls},
    Panel{"goal", "Goal", Column::context, false, &draw_goal},
    Panel{"section", "Section", Column::context, true, &draw_section},
    Panel{"wheel", "Wheel", Column::context, false, &draw_wheel},
    Panel{"force", "Force", Column::diagnostics, true, &draw_force},
    Panel{"certificate", "Certificate", Column::diagnostics, true, &draw_certificate},
    Panel{"ledger", "Clay balance", Column::diagnostics, false, &draw_ledger},
    Panel{"stress", "Stress", Column::diagnostics, false, &draw_stress},
    Panel{"servo", "Timing", Column::diagnostics, false, &draw_servo},
};

constexpr ImGuiWindowFlags kFixed = ImGuiWindowFlags_NoTitleBar | ImGuiWindowFlags_NoResize |
                                    ImGuiWindowFlags_NoMove | ImGuiWindowFlags_NoCollapse |
                                    ImGuiWindowFlags_NoSavedSettings |
                                    ImGuiWindowFlags_NoBringToFrontOnFocus;

bool is_open(const Settings& settings, const char* id, bool usual = false) {
  const auto remembered = settings.open.find(id);
  return remembered == settings.open.end() ? usual : remembered->second;
}

bool is_open(const Settings& settings, const Panel& panel) {
  return is_open(settings, panel.id, panel.open);
}

/// The header of the tool's panel has the name of the tool.
bool draw_header(const Panel& panel, const ViewModel& model) {
  const ImVec2 padding = ImGui::GetStyle().FramePadding;
  ImGui::PushStyleVar(ImGuiStyleVar_FramePadding, ImVec2(0.5f * padding.x, padding.y));
  const std::string_view title =
      panel.draw == &draw_tool ? name_of(model.tool_in_use().mode) : panel.title;
  const bool shown = ImGui::CollapsingHeader(fmt::format("{}###{}", title, panel.title).c_str());
  ImGui::PopStyleVar();
  return shown;
}

/// Scrolls by the minimum that shows the content from this corner to the cursor.
void scroll_to(ImVec2 corner) {
  const ImVec2 end(corner.x, ImGui::GetCursorScreenPos().y);
  ImGui::ScrollToRect(ImGui::GetCurrentWindow(), ImRect(corner, end),
                      ImGuiScrollFlags_KeepVisibleEdgeY);
}

/// Arrows that a menu within a menu needs.
struct UsedArrows {
  bool left = false, right = false;
};

UsedArrows draw_recent(const ViewModel& model, Actions& actions) {
  const bool open = ImGui::BeginMenu("Recent", !model.settings.recent.empty());
  if (!open) return {false, ImGui::IsItemFocused() && !model.settings.recent.empty()};
  for (const std::string& path : model.settings.recent) {
    ImGui::PushID(path.c_str());
    if (ImGui::MenuItem(shown_name(path).c_str())) actions.emplace_back(OpenFile{path});
    ImGui::PopID();
  }
  ImGui::EndMenu();
  return {true, true};
}

/// Left and Right go from an open menu to its neighbours.
void walk_menus(std::size_t open, const UsedArrows& used, Actions& actions) {
  const std::size_t count = menus().size();
  const auto pressed = [](ImGuiKey key) { return ImGui::IsKeyPressed(ImGui::GetKeyIndex(key)); };
  const bool left = !used.left && pressed(ImGuiKey_LeftArrow);
  if (!left && (used.right || !pressed(ImGuiKey_RightArrow))) return;
  ImGui::NavMoveRequestCancel();  // otherwise ImGui closes the menu
  actions.emplace_back(OpenMenu{(open + (left ? count - 1 : 1)) % count});
}

/// The first commands of groups within a menu.
constexpr std::array<std::string_view, 16> kGroups = {
    "file.new_bowl", "file.learn_bowl", "file.open",        "file.save",
    "file.export",   "file.settings",   "file.quit",        "edit.to_start",
    "tool.next",     "tool.sphere",     "tool.smaller",     "view.nearer",
    "view.cut_half", "view.goal",       "view.certificate", "view.theme"};

/// The commands that are needed most, at the right end of the menu.
void draw_main_buttons(const ViewModel& model, Actions& actions) {
  struct Shown {
    std::string_view id;
    const char* title;
  };
  constexpr std::array kShown = {Shown{"edit.undo", "Undo"}, Shown{"edit.redo", "Redo"},
                                 Shown{"file.save", "Save"}, Shown{"file.export", "Export"}};
  const ImGuiStyle& style = ImGui::GetStyle();
  const float pad = 0.6f * ImGui::GetFontSize();
  float width = style.WindowPadding.x;
  for (const Shown& shown : kShown)
    width += ImGui::CalcTextSize(shown.title).x + 2.0f * pad + style.ItemInnerSpacing.x;
  const float left = ImGui::GetWindowWidth() - width;
  if (left < ImGui::GetCursorPosX()) return;  // no room: they are in the menu
  ImGui::SetCursorPos({left, 0.1f * ImGui::GetFontSize()});
  ImGui::PushStyleVar(ImGuiStyleVar_FramePadding, ImVec2(pad, style.FramePadding.y - 2.0f));
  for (const Shown& shown : kShown) {
    const Command& command = *find_command(shown.id);
    const bool enabled = command.enabled(model);
    const bool main = shown.id == "file.export" && enabled && model.ui.shows<NoDialog>();
    ImGui::BeginDisabled(!enabled);
    const bool clicked =
        main ? main_button(shown.title, model.colours()) : ImGui::Button(shown.title);
    ImGui::EndDisabled();
    if (ImGui::IsItemHovered(ImGuiHoveredFlags_AllowWhenDisabled))
      ImGui::SetTooltip("%s", tip_of(command, model).c_str());
    if (clicked) actions.emplace_back(RunCommand{shown.id});
    ImGui::SameLine(0.0f, style.ItemInnerSpacing.x);
  }
  ImGui::PopStyleVar();
}

constexpr float kLeastNameEm = 6.0f;  // of the document, in the status bar

constexpr ImGuiWindowFlags kBar = ImGuiWindowFlags_NoTitleBar | ImGuiWindowFlags_NoResize |
                                  ImGuiWindowFlags_NoMove | ImGuiWindowFlags_NoScrollbar |
                                  ImGuiWindowFlags_NoCollapse | ImGuiWindowFlags_NoSavedSettings;

struct Part {
  std::string text;
  ImVec4 colour;
};

/// Figures of the loop that moves the tool, and of the clay that is counted.
void add_figures(const ViewModel& model, std::vector<Part>& parts) {
  const servo::LiveStatus& status = model.stroke.status();
  const Palette& colours = model.colours();
  if (model.stroke.throwing())
    parts.push_back({fmt::format("{:.0f} Hz", model.stroke.tick_rate_hz()), colours.faint});
  parts.push_back({fmt::format("{} missed ticks", status.missed),
                   status.missed > 0 ? colours.warning : colours.faint});
  if (model.document.has_work())
    parts.push_back({fmt::format("clay unaccounted for: {:.0f}", std::abs(status.volume_error)),
                     status.volume_error != 0.0 ? colours.fault : colours.faint});
}

/// The name of the document is as short as the rest of the bar needs.
std::string document_text(const ViewModel& model, float room_px) {
  if (!model.document.has_work()) return "No clay on the wheel";
  const std::string state = !model.document.unsaved()    ? ""
                            : model.document.pot_saved() ? " \xe2\x80\xa2 strokes not saved"
                                                         : " \xe2\x80\xa2 not saved";
  const float least = kLeastNameEm * ImGui::GetFontSize();
  const float room = room_px - ImGui::CalcTextSize(state.c_str()).x;
  return shortened(model.document.name(), std::max(least, room)) + state;
}

void draw_parts(const ViewModel& model, const std::vector<Part>& parts) {
  const float gap = 1.6f * ImGui::GetFontSize();
  float room = ImGui::GetContentRegionAvail().x;
  for (const Part& part : parts) room -= gap + ImGui::CalcTextSize(part.text.c_str()).x;
  ImGui::TextUnformatted(document_text(model, room).c_str());
  for (const Part& part : parts) {
    ImGui::SameLine(0.0f, gap);
    const std::string text = shortened(part.text, ImGui::GetContentRegionAvail().x);
    ImGui::TextColored(part.colour, "%s", text.c_str());
  }
}

ImVec4 colour_of(Grade grade, const Palette& colours) {
  return grade == Grade::note      ? colours.faint
         : grade == Grade::warning ? colours.warning
                                   : colours.fault;
}

}  // namespace

bool diagnostics_open(const Settings& settings) { return is_open(settings, kDiagnostics); }

bool below_open(const Settings& settings) { return is_open(settings, kBelow); }

bool in_diagnostics(std::string_view id) {
  const auto* panel = std::ranges::find(kPanels, id, &Panel::id);
  return panel != kPanels.end() && panel->column == Column::diagnostics;
}

bool panel_open(const Settings& settings, const UiState& ui, std::string_view id) {
  const auto* panel = std::ranges::find(kPanels, id, &Panel::id);
  return panel != kPanels.end() && is_open(settings, *panel) &&
         (panel->column == Column::context ? ui.context_shown : diagnostics_open(settings));
}

Wanted wanted_of(const Settings& settings, const UiState& ui) {
  return {true, panel_open(settings, ui, "servo"), settings.process, ui.target,
          0.01 * settings.goal.shrinkage_percent};
}

void draw_column(const ViewModel& model, Actions& actions, Column column, glm::vec2 corner_px,
                 glm::vec2 size_px) {
  ImGui::SetNextWindowPos({corner_px.x, corner_px.y});
  ImGui::SetNextWindowSize({size_px.x, size_px.y});
  begin_window(column == Column::context ? "##context" : "##diagnostics", kFixed);
  if (model.ui.focus_column && model.ui.keys_in == column) ImGui::SetWindowFocus();
  for (const Panel& panel : kPanels) {
    if (panel.column != column) continue;
    const bool open = is_open(model.settings, panel);
    const ImVec2 corner = ImGui::GetCursorScreenPos();
    ImGui::SetNextItemOpen(open);
    const bool shown = draw_header(panel, model);
    if (shown != open) actions.emplace_back(FoldPanel{panel.id, shown});
    if (!shown) continue;
    ImGui::PushID(panel.id);
    panel.draw(model, actions);
    ImGui::Spacing();
    ImGui::PopID();
    if (model.ui.reveal == panel.id) scroll_to(corner);
  }
  ImGui::End();
}

float draw_menu(const ViewModel& model, Actions& actions) {
  if (!ImGui::BeginMainMenuBar()) return 0.0f;
  // In a low window the longest menu fits without lines only.
  const bool grouped = ImGui::GetIO().DisplaySize.y > 42.0f * ImGui::GetFontSize();
  if (model.ui.open_menu) ImGui::OpenPopup(menus()[*model.ui.open_menu].title);
  for (std::size_t i = 0; i < menus().size(); ++i) {
    const Menu& menu = menus()[i];
    if (!ImGui::BeginMenu(menu.title)) continue;
    UsedArrows used;
    // Space between the title of a command and its keys.
    const ImVec2 spacing = ImGui::GetStyle().ItemSpacing;
    ImGui::PushStyleVar(ImGuiStyleVar_ItemSpacing, ImVec2(2.5f * spacing.x, spacing.y));
    for (const Command& command : commands()) {
      if (!command.id.starts_with(menu.prefix)) continue;
      if (grouped && std::ranges::find(kGroups, command.id) != kGroups.end()) ImGui::Separator();
      const bool on = command.checked != nullptr && command.checked(model);
      if (ImGui::MenuItem(command.title, text_of(command.chord).c_str(), on,
                          command.enabled(model)))
        actions.emplace_back(RunCommand{command.id});
      if (command.checked != nullptr) mark_chosen(command.title, on);
      if (!command.enabled(model) && command.why_not != nullptr &&
          ImGui::IsItemHovered(ImGuiHoveredFlags_AllowWhenDisabled))
        ImGui::SetTooltip("%s", tip_of(command, model).c_str());
      if (command.id == "file.open") used = draw_recent(model, actions);
    }
    ImGui::PopStyleVar();
    ImGui::EndMenu();
    walk_menus(i, used, actions);
  }
  draw_main_buttons(model, actions);
  const float height = ImGui::GetWindowSize().y;
  ImGui::EndMainMenuBar();
  return height;
}

float status_height() { return std::round(1.75f * ImGui::GetFontSize()); }

void draw_status_bar(const ViewModel& model, glm::vec2 corner_px, glm::vec2 size_px) {
  ImGui::SetNextWindowPos({corner_px.x, corner_px.y});
  ImGui::SetNextWindowSize({size_px.x, size_px.y});
  ImGui::PushStyleVar(ImGuiStyleVar_WindowPadding,
                      ImVec2(ImGui::GetStyle().WindowPadding.x, 0.3f * ImGui::GetFontSize()));
  ImGui::PushStyleVar(ImGuiStyleVar_WindowMinSize, ImVec2(1.0f, 1.0f));
  ImGui::PushStyleColor(ImGuiCol_WindowBg, ImGui::GetStyleColorVec4(ImGuiCol_MenuBarBg));
  begin_window("##status", kBar);
  const Palette& colours = model.colours();
  const ImVec4 text = ImGui::GetStyleColorVec4(ImGuiCol_Text);
  std::vector<Part> parts{{model.device_name(), text}};
  const std::string arm = model.arm_text();
  const bool attention = model.stroke.paused() || model.waits_for_rearm();
  const std::string state = arm.empty() && model.stroke.paused() ? "paused" : arm;
  if (!state.empty()) parts.push_back({state, attention ? colours.warning : text});
  if (diagnostics_open(model.settings)) add_figures(model, parts);
  draw_parts(model, parts);
  ImGui::End();
  ImGui::PopStyleColor();
  ImGui::PopStyleVar(2);
}

namespace {

/// Whether the notice appeared while the present dialog was open, such as the error of a save. Then
/// it is drawn over the veil.
bool answers_dialog(const ViewModel& model, const Notice& notice) {
  const std::size_t dialog = model.ui.dialog.index();
  return !model.ui.shows<NoDialog>() && notice.dialog.value_or(dialog) == dialog &&
         !ImGui::IsPopupOpen("", ImGuiPopupFlags_AnyPopupId | ImGuiPopupFlags_AnyPopupLevel);
}

/// Returns its lower edge, or `top_px` if it is not shown.
float draw_notice(const ViewModel& model, const std::optional<Notice>& notice,
                  const CloseNotice& close, Actions& actions, const ViewRect& rect, float top_px) {
  if (!notice) return top_px;
  // A note does not cover a dialog.
  if (notice->grade == Grade::note && !model.ui.shows<NoDialog>()) return top_px;
  const float pad = ImGui::GetFontSize();
  const float width = std::min(rect.size_px.x - 2.0f * pad, 40.0f * ImGui::GetFontSize());
  ImGui::SetNextWindowPos(
      {rect.corner_px.x + 0.5f * (rect.size_px.x - width), top_px + 0.5f * pad});
  ImGui::SetNextWindowSize({width, 0.0f});
  ImGui::PushStyleVar(ImGuiStyleVar_WindowRounding, 0.4f * pad);
  ImGui::PushStyleVar(ImGuiStyleVar_WindowBorderSize, 1.0f);
  ImGui::PushStyleColor(ImGuiCol_WindowBg, ImGui::GetStyleColorVec4(ImGuiCol_PopupBg));
  const ImVec4 colour = colour_of(notice->grade, model.colours());
  ImGui::PushStyleColor(ImGuiCol_Border, colour);
  begin_window(close.state ? "##state" : "##answer",
               kBar | ImGuiWindowFlags_AlwaysAutoResize | ImGuiWindowFlags_NoFocusOnAppearing);
  if (answers_dialog(model, *notice)) ImGui::BringWindowToDisplayFront(ImGui::GetCurrentWindow());
  const char* grade = notice->grade == Grade::note      ? "Note"
                      : notice->grade == Grade::warning ? "Warning"
                                                        : "Error";
  ImGui::TextColored(colour, "%s", grade);
  ImGui::SameLine(ImGui::GetContentRegionMax().x - ImGui::CalcTextSize("Close").x -
                  2.0f * ImGui::GetStyle().FramePadding.x);
  const bool closed = ImGui::Button("Close");
  wrapped_text(notice->text);
  if (const Command* command = find_command(notice->command); command != nullptr)
    if (ImGui::Button(command->title)) {
      actions.emplace_back(RunCommand{command->id});
      actions.emplace_back(close);
    }
  const float foot = ImGui::GetWindowPos().y + ImGui::GetWindowSize().y;
  ImGui::End();
  ImGui::PopStyleColor(2);
  ImGui::PopStyleVar(2);
  if (closed) actions.emplace_back(close);
  return foot;
}

}  // namespace

void draw_banners(const ViewModel& model, Actions& actions, const ViewRect& rect, float top_px) {
  const Notices& notices = model.ui.notices;
  top_px = draw_notice(model, notices.state(), CloseNotice{true}, actions, rect, top_px);
  (void)draw_notice(model, notices.answer(), CloseNotice{false}, actions, rect, top_px);
}

void draw_hint(const ViewModel& model, Actions& actions, const ViewRect& rect) {
  if (!model.settings.hints || !model.ui.shows<NoDialog>() || model.stroke.throwing() ||
      model.guide.active() || (model.document.has_work() && model.document.work().size() > 1))
    return;
  const char* text =
      model.fingers ? "Drag a finger on the clay to shape it. Two fingers turn the view and zoom."
                    : "Hold the left button on the clay and drag to shape it. The middle or right "
                      "button turns the view, the wheel zooms. ? lists all keys.";
  // In the corner, beside the pot.
  const float pad = ImGui::GetFontSize();
  const float width = std::min(rect.size_px.x - 2.0f * pad, 18.0f * pad);
  ImGui::SetNextWindowPos({rect.corner_px.x + pad, rect.corner_px.y + rect.size_px.y - pad},
                          ImGuiCond_Always, {0.0f, 1.0f});
  ImGui::SetNextWindowSize({width, 0.0f});
  ImGui::PushStyleVar(ImGuiStyleVar_WindowRounding, 0.4f * pad);
  ImGui::PushStyleColor(ImGuiCol_WindowBg, ImGui::GetStyleColorVec4(ImGuiCol_PopupBg));
  begin_window("##hint",
               kBar | ImGuiWindowFlags_AlwaysAutoResize | ImGuiWindowFlags_NoFocusOnAppearing);
  wrapped_text(text);
  if (ImGui::Button("Hide")) actions.emplace_back(SetHints{false});
  ImGui::End();
  ImGui::PopStyleColor();
  ImGui::PopStyleVar();
}

}  // namespace clay::studio
