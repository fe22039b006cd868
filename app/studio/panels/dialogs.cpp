// Small dialogs: unsaved changes, file names, settings.

#include "app/studio/panels/panels.hpp"
#include "app/studio/panels/value_slider.hpp"
#include "app/studio/panels/widgets.hpp"

#include <imgui_stdlib.h>

#include <fmt/format.h>
#include <array>
#include <string>

namespace clay::studio {
namespace {

void draw_look_settings(const ViewModel& model, Actions& actions) {
  const Settings& settings = model.settings;
  constexpr std::array kThemes = {"Dark", "Light"};
  form_row("Theme");
  const int theme = choice_row("##theme", kThemes, settings.theme == Theme::dark ? 0 : 1);
  if (theme >= 0) actions.emplace_back(SetTheme{theme == 0 ? Theme::dark : Theme::light});
  // Applied when the mouse is released; otherwise the slider would move under the pointer.
  ImGuiStorage& kept = *ImGui::GetStateStorage();
  const ImGuiID id = ImGui::GetID("scale");
  float scale = ImGui::IsAnyItemActive() ? kept.GetFloat(id, settings.scale) : settings.scale;
  form_slider("Text scale", scale, kSmallestScale, kLargestScale, fmt::format("{:.2f}", scale),
              kPlain);
  kept.SetFloat(id, scale);
  if (ImGui::IsItemDeactivatedAfterEdit()) actions.emplace_back(SetScale{scale});
  constexpr std::array kUnits = {"mm", "cm", "in"};
  form_row("Length unit");
  const int unit = choice_row("##unit", kUnits, static_cast<int>(settings.unit));
  if (unit >= 0) actions.emplace_back(SetUnit{static_cast<LengthUnit>(unit)});
}

void draw_work_settings(const ViewModel& model, Actions& actions) {
  const Settings& settings = model.settings;
  float speed = static_cast<float>(settings.pressing_mm_s);
  if (form_slider("Speed in clay", speed, static_cast<float>(kSlowestHandMmPerS),
                  static_cast<float>(kFastestHandMmPerS),
                  "at most " + speed_text(settings.pressing_mm_s, settings.unit), kSpeeds))
    actions.emplace_back(SetHandSpeed{static_cast<double>(speed)});
  float bite = static_cast<float>(settings.bite_mm);
  if (form_slider("Strength of the hand", bite, static_cast<float>(kSoftestBiteMm),
                  static_cast<float>(kFirmestBiteMm),
                  length_text(settings.bite_mm, settings.unit) + " per turn",
                  lengths_in(settings.unit), ImGuiSliderFlags_Logarithmic))
    actions.emplace_back(SetBite{static_cast<double>(bite)});
  form_row("Process");
  std::string process = settings.process;
  if (choose_process(model, "None", process, actions)) actions.emplace_back(SetProcess{process});
  std::string folder = settings.folder;
  if (!kInPage) form_row("Output folder");
  if (!kInPage &&
      ImGui::InputTextWithHint("##folder", "The folder where the window was started", &folder))
    actions.emplace_back(SetFolder{folder});
  form_row("First steps");
  bool hints = settings.hints;
  if (ImGui::Checkbox("Show in the view", &hints)) actions.emplace_back(SetHints{hints});
}

/// A field for a file name. Enter or the button emits `done`.
template <class Done>
void draw_path(const std::string& path, const char* help, const char* button,
               const ViewModel& model, Actions& actions) {
  // After a failed attempt the dialog is still open: the name can be corrected at once.
  ImGuiStorage& kept = *ImGui::GetStateStorage();
  const ImGuiID tried = ImGui::GetID("tried");
  if (ImGui::IsWindowAppearing() || kept.GetBool(tried)) ImGui::SetKeyboardFocusHere();
  ImGui::SetNextItemWidth(kToEdge);
  std::string typed = path;
  const bool entered = ImGui::InputText("##path", &typed, ImGuiInputTextFlags_EnterReturnsTrue);
  if (typed != path) actions.emplace_back(EditPath{typed});
  faint_text(model.colours(), help);
  const bool clicked = main_button(button, model.colours());
  if ((clicked || entered) && !typed.empty()) actions.emplace_back(Done{typed});
  kept.SetBool(tried, clicked || entered);
  same_line_if_room("Cancel (Esc)");
  if (ImGui::Button("Cancel (Esc)")) actions.emplace_back(CloseDialog{});
}

}  // namespace

void draw_dialog(const ViewModel& model, Actions& actions, const ViewRect& rect) {
  std::visit([&](const auto& dialog) { draw(dialog, model, actions, rect); }, model.ui.dialog);
}

void draw(const NoDialog&, const ViewModel&, Actions&, const ViewRect&) {}

void draw(const UnsavedDialog&, const ViewModel& model, Actions& actions, const ViewRect& rect) {
  begin_dialog("##unsaved", rect, 34.0f);
  dialog_title(model, "Save this pot?");
  wrapped_text(model.document.pot_saved()
                   ? "The pot is in a file, but its strokes are not: only NAME.work keeps them."
               : model.document.file().empty() ? "It has not been saved yet."
                                               : "It has changed since it was last saved.");
  ImGui::Spacing();
  if (main_button("Save (Enter)", model.colours())) actions.emplace_back(RunCommand{"quit.save"});
  same_line_if_room("Discard changes (Ctrl+D)");
  if (ImGui::Button("Discard changes (Ctrl+D)")) actions.emplace_back(RunCommand{"quit.discard"});
  same_line_if_room("Cancel (Esc)");
  if (ImGui::Button("Cancel (Esc)")) actions.emplace_back(RunCommand{"quit.cancel"});
  ImGui::End();
}

void draw(const OpenDialog& dialog, const ViewModel& model, Actions& actions,
          const ViewRect& rect) {
  begin_dialog("##open", rect, 40.0f);
  if (dialog.target) {
    dialog_title(model, "Open a target");
    draw_path<UseTarget>(dialog.path,
                         "A pot, a work, or a drawing of a section (SVG, DXF, CSV). Its outline "
                         "is shown over the pot on the wheel",
                         "Open (Enter)", model, actions);
    return ImGui::End();
  }
  dialog_title(model, "Open");
  draw_path<OpenFile>(dialog.path,
                      "A scene, a pot, a work, or a drawing of a section (SVG, DXF, CSV)",
                      "Open (Enter)", model, actions);
  ImGui::End();
}

void draw(const SaveDialog& dialog, const ViewModel& model, Actions& actions,
          const ViewRect& rect) {
  begin_dialog("##save", rect, 40.0f);
  dialog_title(model, "Save as");
  draw_path<SaveFile>(
      dialog.path, "NAME.work keeps all strokes; NAME.pot.json and NAME.pot.cbor keep only the pot",
      "Save (Enter)", model, actions);
  ImGui::End();
}

void draw(const ReplaceDialog& dialog, const ViewModel& model, Actions& actions,
          const ViewRect& rect) {
  begin_dialog("##replace", rect, 38.0f);
  dialog_title(model, "Replace?");
  wrapped_text(dialog.question);
  ImGui::Spacing();
  if (main_button("Cancel (Esc)", model.colours())) actions.emplace_back(KeepFiles{});
  same_line_if_room("Replace (Ctrl+Shift+R)");
  if (ImGui::Button("Replace (Ctrl+Shift+R)")) actions.emplace_back(RunCommand{"replace.confirm"});
  ImGui::End();
}

void draw(const DiscardDialog& dialog, const ViewModel& model, Actions& actions,
          const ViewRect& rect) {
  begin_dialog("##discard", rect, 38.0f);
  dialog_title(model, dialog.is_file() ? "Delete this work?" : "Discard this work?");
  wrapped_text(dialog.work);
  wrapped_text(!dialog.is_file() ? "It was not saved. Discard deletes it."
               : kInPage         ? "The browser deletes it. Downloads of it remain."
                                 : "Its file is deleted.");
  ImGui::Spacing();
  if (main_button("Keep (Esc)", model.colours())) actions.emplace_back(CloseDialog{});
  const char* button = dialog.is_file() ? "Delete (Ctrl+Shift+D)" : "Discard (Ctrl+Shift+D)";
  same_line_if_room(button);
  if (ImGui::Button(button)) actions.emplace_back(RunCommand{"recover.confirm"});
  ImGui::End();
}

void draw(const SettingsDialog&, const ViewModel& model, Actions& actions, const ViewRect& rect) {
  begin_dialog("##settings", rect, 34.0f);
  dialog_title(model, "Settings");
  draw_look_settings(model, actions);
  draw_work_settings(model, actions);
  ImGui::Spacing();
  const std::string path = settings_path().string();
  faint_text(model.colours(), path.empty() ? "Not stored: there is no home folder"
                              : kInPage    ? "Stored in this browser"
                                           : "Stored in " + path);
  if (ImGui::Button("Close (Esc)")) actions.emplace_back(CloseDialog{});
  ImGui::End();
}

}  // namespace clay::studio
