// The dialog for a picture or a turntable of the pot.

#include "app/studio/commands.hpp"
#include "app/studio/panels/panels.hpp"
#include "app/studio/panels/widgets.hpp"
#include "core/text.hpp"

#include <fmt/format.h>
#include <imgui_stdlib.h>

#include <algorithm>
#include <array>
#include <filesystem>

namespace clay::studio {
namespace {

constexpr std::array kPictureSizes = {render::Viewport{1280, 720},  render::Viewport{1920, 1080},
                                      render::Viewport{3840, 2160}, render::Viewport{1080, 1080},
                                      render::Viewport{1080, 1350}, render::Viewport{2048, 2048}};
constexpr std::array kTurntableSizes = {render::Viewport{320, 320}, render::Viewport{480, 480},
                                        render::Viewport{640, 480}, render::Viewport{720, 720}};
constexpr int kSmallestSidePx = 16, kFewestFrames = 8, kMostShownFrames = 120;

void draw_size(PictureFile& file) {
  form_row("Size");
  const float em = ImGui::GetFontSize();
  std::array<int, 2> sides = {file.look.size.width_px, file.look.size.height_px};
  ImGui::SetNextItemWidth(9.0f * em);
  if (ImGui::InputInt2("##sides", sides.data()))
    file.look.size = {std::clamp(sides[0], kSmallestSidePx, render::kMaxSidePx),
                      std::clamp(sides[1], kSmallestSidePx, render::kMaxSidePx)};
  ImGui::SameLine();
  ImGui::SetNextItemWidth(kToEdge);
  if (!begin_list("Size", "Usual sizes")) return;
  const auto offer = [&](const auto& sizes) {
    for (const render::Viewport& size : sizes)
      if (ImGui::Selectable(fmt::format("{} \xc3\x97 {}", size.width_px, size.height_px).c_str(),
                            size == file.look.size))
        file.look.size = size;
  };
  if (file.turntable)
    offer(kTurntableSizes);
  else
    offer(kPictureSizes);
  ImGui::EndCombo();
}

void draw_shown(PictureFile& file) {
  form_row("Show");
  const float left = ImGui::GetCursorPosX();
  bool lines = file.look.style == render::Style::clay;
  if (ImGui::Checkbox("Throwing lines", &lines))
    file.look.style = lines ? render::Style::clay : render::Style::geometry;
  next_box("Cut open", file.look.section, left);
  next_box("Wall map", file.wall_map, left);
}

void draw_background(PictureFile& file) {
  constexpr std::array kBackgrounds = {"Light", "Dark", "Transparent"};
  form_row("Background");
  const int shown = file.look.alone ? 2 : file.look.theme == render::Theme::dark ? 1 : 0;
  const std::size_t count = file.turntable ? 2 : 3;  // a GIF has no smooth transparency
  const int chosen = choice_row("##background", std::span(kBackgrounds).first(count), shown);
  if (chosen < 0) return;
  file.look.alone = chosen == 2;
  if (chosen < 2) file.look.theme = chosen == 1 ? render::Theme::dark : render::Theme::light;
}

void draw_frames(PictureFile& file) {
  form_row("Frames");
  ImGui::SliderInt("##frames", &file.look.frames, kFewestFrames, kMostShownFrames, "%d",
                   ImGuiSliderFlags_AlwaysClamp);
}

/// The result, or a description of the picture, in a place of fixed height.
void draw_state(const ViewModel& model) {
  const PictureState& pictures = model.ui.pictures;
  const Palette& colours = model.colours();
  ImGui::BeginChild("##state", {0.0f, 3.4f * ImGui::GetFontSize()});
  std::error_code ignored;
  const std::filesystem::path path = path_of(pictures.file);
  if (model.picture_running) {
    ImGui::ProgressBar(model.picture_progress, {kToEdge, 0.0f},
                       fmt::format("{:.0f} %", 100.0f * model.picture_progress).c_str());
  } else if (const char* why_not = find_command("export.write")->why_not(model)) {
    wrapped_text(sentence(why_not), colours.warning);
  } else if (!pictures.problem.empty()) {
    wrapped_text(pictures.problem, colours.fault);
  } else if (!pictures.result.empty()) {
    wrapped_text(pictures.result, colours.good);
  } else if (std::filesystem::exists(path, ignored)) {
    faint_text(colours, path.filename().string() + " will be replaced");
  } else {
    faint_text(colours,
               "The whole pot, seen from the direction of the view. Throwing lines and "
               "specks are not in the pot.");
  }
  ImGui::EndChild();
}

void draw_picture_buttons(const ViewModel& model, Actions& actions) {
  if (model.picture_running) {
    if (ImGui::Button("Cancel")) actions.emplace_back(RunCommand{"export.cancel"});
    return;
  }
  const Command& write = *find_command("export.write");
  if (main_button("Export (Ctrl+Enter)", model.colours(), write.enabled(model)))
    actions.emplace_back(RunCommand{write.id});
  if (!model.ui.pictures.written.empty()) {
    same_line_if_room("Open folder");
    if (ImGui::Button("Open folder")) actions.emplace_back(RunCommand{"export.folder"});
  }
  same_line_if_room("Close (Esc)");
  if (ImGui::Button("Close (Esc)")) actions.emplace_back(CloseDialog{});
}

}  // namespace

void draw(const PictureDialog&, const ViewModel& model, Actions& actions, const ViewRect& rect) {
  PictureFile file = model.ui.pictures.file;
  begin_dialog("##picture", rect, 36.0f);
  dialog_title(model, file.turntable ? "Export turntable" : "Export picture");
  draw_size(file);
  form_row("Surface");
  if (const Material* chosen = choose_material(file.look.material)) file.look.material = *chosen;
  draw_shown(file);
  draw_background(file);
  if (file.turntable) draw_frames(file);
  form_place(file.name, file.folder, actions);
  if (file != model.ui.pictures.file) actions.emplace_back(EditPicture{file});
  ImGui::Spacing();
  draw_state(model);
  draw_picture_buttons(model, actions);
  ImGui::End();
}

}  // namespace clay::studio
