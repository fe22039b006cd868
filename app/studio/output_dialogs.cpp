#include "app/studio/output_dialogs.hpp"

#include "app/studio/app_state.hpp"
#include "core/user_folder.hpp"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <glm/trigonometric.hpp>
#include <memory>
#include <numbers>
#include <string>
#include <utility>
#include <vector>

namespace clay::studio {
namespace {

constexpr render::Viewport kUsualPicture{1920, 1080}, kUsualTurntable{480, 480};  // [px]

std::string replace_question(const std::vector<std::string>& files) {
  std::string names;
  for (const std::string& file : files)
    names.append(names.empty() ? "" : ", ").append(std::filesystem::path(file).filename().string());
  return names + (files.size() == 1 ? " exists in the folder." : " exist in the folder.");
}

std::string export_name(const AppState& state) {
  const std::string& scene = state.document.scene().name;
  const std::filesystem::path& file = state.document.file();
  return !file.empty() ? file.stem().string() : scene.empty() ? "pot" : scene;
}

std::string export_folder(const AppState& state) {
  return state.settings.folder.empty() ? current_folder().string() : state.settings.folder;
}

}  // namespace

void write_export(AppState& state, bool replace) {
  ExportState& exporting = state.ui.exporting;
  std::vector<std::string> standing = standing_files(exporting.choices);
  // Those of the last export are the user's own, of this pot.
  std::erase_if(standing, [&](const std::string& path) {
    return std::ranges::find(exporting.written, path) != exporting.written.end();
  });
  if (!replace && !standing.empty()) {
    state.log("prompt: replace");
    state.ui.dialog = ReplaceDialog{replace_question(standing), std::nullopt};
    return;
  }
  exporting.written.clear();
  exporting.problem.clear();
  exporting.result.clear();
  exporting.grade = Grade::note;
  state.log("export started");
  state.exporter.write(state.document.shared_pot(), exporting.choices);
}

void show_written_folder(AppState& state) {
  const std::vector<std::string>& files = state.ui.exporting.written;
  const std::string file = state.ui.shows<PictureDialog>() ? state.ui.pictures.written
                           : files.empty()                 ? std::string()
                                                           : files.front();
  if (file.empty()) return;
  const auto folder = std::filesystem::path(file).parent_path();
  if (!show_folder(folder))
    state.ui.notices.show(Grade::warning,
                          "No file manager is installed. The files are in " +
                              (folder.empty() ? "the current folder" : folder.string()));
}

void show_picture(AppState& state, bool turntable) {
  show_present(state);
  PictureState& pictures = state.ui.pictures;
  if (state.pictures.busy()) {  // show its progress
    state.ui.dialog = PictureDialog{};
    return;
  }
  const Settings& settings = state.settings;
  const bool first = pictures.file.name.empty() || pictures.file.turntable != turntable;
  PictureFile file = pictures.file;
  file.turntable = turntable;
  if (first) {
    file.look.size = turntable ? kUsualTurntable : kUsualPicture;
    file.look.alone = false;
    file.look.theme = settings.theme;
  }
  file.look.material = settings.material;
  file.look.style = settings.throwing_lines ? render::Style::clay : render::Style::geometry;
  file.look.section = state.scene.cut != render::Cut::none;
  const render::Camera& camera = state.scene.camera();
  // In tenths, to be typed after `render --azimuth` and `--elevation`.
  const auto degrees = [](double rad) {
    return 0.1 * std::round(10.0 * glm::degrees(std::remainder(rad, 2.0 * std::numbers::pi)));
  };
  file.look.azimuth_deg = degrees(camera.azimuth_rad);
  file.look.elevation_deg = degrees(camera.elevation_rad);
  file.wall_map = settings.wall_map;
  file.process = settings.process;
  file.name = export_name(state);
  file.folder = export_folder(state);
  pictures = {.file = std::move(file), .written = {}, .problem = {}, .result = {}};
  state.ui.dialog = PictureDialog{};
}

void write_picture(AppState& state, bool replace) {
  PictureState& pictures = state.ui.pictures;
  if (state.pictures.busy()) return;
  const std::string path = path_of(pictures.file);
  std::error_code ignored;
  if (!replace && path != pictures.written && std::filesystem::exists(path, ignored)) {
    state.log("prompt: replace");
    state.ui.dialog = ReplaceDialog{replace_question({path}), std::nullopt, true};
    return;
  }
  pictures.written.clear();
  pictures.problem.clear();
  pictures.result.clear();
  state.log("picture started");
  state.pictures.write(state.document.shared_pot(), pictures.file);
}

void show_export(AppState& state) {
  show_present(state);
  ExportState& exporting = state.ui.exporting;
  ExportChoices& choices = exporting.choices;
  choices.process = state.settings.process;
  choices.name = export_name(state);
  choices.folder = export_folder(state);
  choices.material = state.settings.material.id;
  exporting = ExportState{.choices = choices};
  state.ui.dialog = ExportDialog{};
}

}  // namespace clay::studio
