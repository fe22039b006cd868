#include "app/studio/output_dialogs.hpp"

#include "app/studio/app_state.hpp"
#include "core/user_folder.hpp"

#include <fmt/format.h>

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

constexpr double kExportNoteS = 6.0;
constexpr render::Viewport kUsualPicture{1920, 1080}, kUsualTurntable{480, 480};  // [px]

std::string replace_question(const std::vector<std::string>& files) {
  std::string names;
  for (const std::string& file : files)
    names.append(names.empty() ? "" : ", ").append(std::filesystem::path(file).filename().string());
  return names + (files.size() == 1 ? " exists in the folder." : " exist in the folder.");
}

std::string export_folder(const AppState& state) {
  return state.settings.folder.empty() ? current_folder().string() : state.settings.folder;
}

}  // namespace

void write_export(AppState& state, bool replace) {
  ExportState& exporting = state.ui.exporting;
  std::vector<std::string> standing = standing_files(exporting.choices);
  // Files of the last export may be replaced without a question: they belong to this work.
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
  exporting.of_other_work = false;
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
  file.name = state.document.title();
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
  pictures.of_other_work = false;
  state.log("picture started");
  state.pictures.write(state.document.shared_pot(), pictures.file);
}

void show_export(AppState& state) {
  show_present(state);
  ExportState& exporting = state.ui.exporting;
  ExportChoices& choices = exporting.choices;
  choices.process = state.settings.process;
  choices.name = state.document.title();
  choices.folder = export_folder(state);
  choices.material = state.settings.material.id;
  exporting = ExportState{.choices = choices, .of_other_work = exporting.of_other_work};
  state.ui.dialog = ExportDialog{};
}

namespace {

/// The pot on the wheel has the problems of the export only if the export changes no wall.
bool exports_as_thrown(const ExportChoices& choices) {
  return choices.size == ExportSize::as_thrown && choices.foot_width_mm <= 0.0 &&
         choices.floor_fillet_mm <= 0.0 && choices.lip_fillet_mm <= 0.0 &&
         choices.glaze_mm <= 0.0 && choices.drain_mm <= 0.0;
}

void mark_problems(AppState& state, const Exporter::Outcome& outcome) {
  state.ui.marks.clear();
  if (exports_as_thrown(outcome.choices)) state.ui.marks = outcome.done->marks;
  state.ui.marked = outcome.pot;
}

std::string result_text(const ExportFigures& figures, std::size_t count) {
  std::string text = fmt::format("{} file{} written", count, count == 1 ? "" : "s");
  std::uint64_t bytes = 0;
  for (const ExportFigures::Mesh& mesh : figures.meshes) bytes += mesh.bytes;
  if (!figures.meshes.empty())
    text += fmt::format("; {} triangles, {:.2f} MB of meshes, each proved and read back",
                        figures.triangles, 1e-6 * static_cast<double>(bytes));
  return figures.failed > 0 ? fmt::format("{}; {}", text, failed_text(figures.failed)) : text;
}

/// The message of the library names rings and a setting that the window does not have.
std::string problem_of(const Exporter::Outcome& outcome, LengthUnit unit) {
  const PotForm form = outcome.pot->collapse ? PotForm{} : form_of(outcome.pot->stack);
  if (!form.parting_mm) return outcome.done.error().message;
  return "The pot is " + parts_text(form, unit) + ". Only a pot in one part can be exported";
}

/// Shows the outcome in its dialog, or as a banner if the user has closed the dialog.
template <class Dialog>
void show_failure(AppState& state, std::string message, std::string& problem) {
  if (!state.ui.shows<Dialog>()) return report(state, {ErrorKind::io, std::move(message)});
  state.log("error: " + message);
  problem = std::move(message);
}

void take_files(AppState& state, Exporter::Outcome outcome) {
  ExportState& exporting = state.ui.exporting;
  if (outcome.cancelled) {
    exporting.result = "Cancelled; no file was written";
    return state.log("export cancelled");
  }
  if (!outcome.done) {
    exporting.result.clear();
    return show_failure<ExportDialog>(state, problem_of(outcome, state.settings.unit),
                                      exporting.problem);
  }
  exporting.result = result_text(*outcome.done, outcome.paths.size());
  exporting.grade = outcome.done->failed > 0 ? Grade::warning : Grade::note;
  // This work may not replace files of another work without a question.
  if (exporting.of_other_work)
    exporting.result = "Of the work before: " + exporting.result;
  else
    exporting.written = outcome.paths;
  if (outcome.done->has_solid && !exporting.of_other_work) {
    mark_problems(state, outcome);
    exporting.preview = std::move(*outcome.done);
  }
  for (const std::string& path : outcome.paths) {
    state.host.file_written(path);
    state.log("exported: " + path);
  }
  if (!state.ui.shows<ExportDialog>()) note(state, exporting.grade, exporting.result, kExportNoteS);
  state.settings.folder = outcome.choices.folder;
}

void take_preview(AppState& state, Exporter::Outcome outcome) {
  ExportState& exporting = state.ui.exporting;
  exporting.preview.reset();
  exporting.problem.clear();
  if (!outcome.done) {
    exporting.problem = problem_of(outcome, state.settings.unit);
    exporting.refused = true;
    return;
  }
  mark_problems(state, outcome);
  exporting.preview = std::move(*outcome.done);
  state.log(fmt::format("export previewed: {} triangles", exporting.preview->triangles));
}

/// The choices that change the solid. A name changes some bytes of a file, but not the figures on
/// screen.
ExportChoices solid_choices(ExportChoices choices) {
  choices.folder.clear();
  choices.name.clear();
  choices.section = choices.dxf = choices.pdf = choices.report = choices.pot = false;
  return choices;
}

}  // namespace

void update_export(AppState& state) {
  ExportState& exporting = state.ui.exporting;
  auto* dialog = std::get_if<ExportDialog>(&state.ui.dialog);
  const bool writing = state.exporter.running() == Exporter::Kind::files;
  const bool stale = dialog != nullptr && (dialog->previewed != solid_choices(exporting.choices) ||
                                           dialog->pot != state.document.shared_pot());
  if (stale && !writing) {
    dialog->previewed = solid_choices(exporting.choices);
    dialog->pot = state.document.shared_pot();
    exporting.preview.reset();
    exporting.problem.clear();
    exporting.refused = false;
    if (exporting.choices.meshes.empty())
      state.exporter.cancel();  // the preview of the choices before
    else
      state.exporter.preview(state.document.shared_pot(), exporting.choices);
  }
  if (!state.host.real_time()) state.exporter.wait();  // frames of a script are reproducible
  auto outcome = state.exporter.take();
  if (!outcome) return;
  if (outcome->kind == Exporter::Kind::files)
    take_files(state, std::move(*outcome));
  else if (dialog != nullptr && dialog->previewed == solid_choices(outcome->choices))
    take_preview(state, std::move(*outcome));
}

void update_picture(AppState& state) {
  const auto outcome = state.pictures.take();
  if (!outcome) return;
  PictureState& pictures = state.ui.pictures;
  if (outcome->cancelled) {
    pictures.result = "Cancelled; no file was written";
    return state.log("picture cancelled");
  }
  if (!outcome->bytes)
    return show_failure<PictureDialog>(state, outcome->bytes.error().message, pictures.problem);
  const std::string written = path_of(outcome->file);
  if (!pictures.of_other_work) pictures.written = written;
  pictures.result = fmt::format("{}: {} \xc3\x97 {} pixels, {:.2f} MB",
                                std::filesystem::path(written).filename().string(),
                                outcome->file.look.size.width_px, outcome->file.look.size.height_px,
                                1e-6 * static_cast<double>(*outcome->bytes));
  state.host.file_written(written);
  state.log("exported: " + written);
  if (!state.ui.shows<PictureDialog>()) note(state, Grade::note, pictures.result, kExportNoteS);
  state.settings.folder = outcome->file.folder;
}

}  // namespace clay::studio
