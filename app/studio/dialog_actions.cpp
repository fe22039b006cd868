// Actions of dialogs, and of the notices.

#include "app/studio/performer.hpp"

#include "app/history/pot_scene.hpp"
#include "app/studio/output_dialogs.hpp"
#include "claystack/export/walls.hpp"
#include "core/text.hpp"

#include <utility>

namespace clay::studio {
namespace {

constexpr double kNoteS = 5.0;

}  // namespace

std::filesystem::path open_folder(const Settings& settings) {
  const std::filesystem::path folder =
      settings.recent.empty() ? std::filesystem::path(settings.folder)
                              : std::filesystem::path(settings.recent.front()).parent_path();
  return folder.empty() ? folder : folder / "";
}

bool open_desktop_dialog(AppState& state, FileDialog::Kind kind,
                         const std::filesystem::path& start) {
  if (!state.host.real_time()) return false;
  if (!state.file_dialog.open()) return state.file_dialog.begin(kind, start);
  note(state, Grade::warning, "The file dialog of the desktop is open: answer or close it first",
       kNoteS);
  return true;
}

void close_dialog(AppState& state) {
  state.ui.focus_column = true;  // if it had the keyboard focus before
  if (state.document.has_work())
    state.ui.dialog = NoDialog{};
  else
    state.ui.dialog = GalleryDialog{};
}

void Performer::operator()(const ShowDialog& show) const {
  switch (show.kind) {
    case DialogKind::gallery:
      state.ui.dialog = GalleryDialog{};
      break;
    case DialogKind::shortcuts:
      state.ui.dialog = ShortcutsDialog{};
      break;
    case DialogKind::settings:
      state.ui.dialog = SettingsDialog{};
      break;
    case DialogKind::open_file:
      if (!open_desktop_dialog(state, FileDialog::Kind::open, open_folder(state.settings)))
        state.ui.dialog = OpenDialog{open_folder(state.settings).string()};
      break;
    case DialogKind::works:
      show_works();
      break;
    case DialogKind::save_file:
      ask_for_name(std::nullopt);
      break;
    case DialogKind::export_files:
      show_export(state);
      break;
    case DialogKind::picture:
    case DialogKind::turntable:
      show_picture(state, show.kind == DialogKind::turntable);
      break;
  }
}

void Performer::operator()(const CloseDialog&) const {
  if (state.ui.shows<ReplaceDialog>()) return (*this)(KeepFiles{});
  if (const auto* asked = std::get_if<DiscardDialog>(&state.ui.dialog)) {
    if (asked->is_file()) return show_works();
    state.ui.dialog = GalleryDialog{};
    return;
  }
  if (auto* unsaved = std::get_if<UnsavedDialog>(&state.ui.dialog); unsaved && unsaved->import) {
    state.ui.dialog = ImportDialog(std::move(*unsaved->import));
    return;
  }
  close_dialog(state);
}

void Performer::operator()(const EditPath& edit) const {
  if (auto* open = std::get_if<OpenDialog>(&state.ui.dialog)) open->path = edit.path;
  if (auto* save = std::get_if<SaveDialog>(&state.ui.dialog)) save->path = edit.path;
}

void Performer::operator()(const SaveAndContinue&) const {
  auto* unsaved = std::get_if<UnsavedDialog>(&state.ui.dialog);
  if (unsaved == nullptr) return;
  unsaved->saving = true;
  if (state.document.file().empty())
    ask_for_name(unsaved->next);
  else
    (*this)(SaveFile{state.document.file()});
}

void Performer::operator()(const DiscardAndContinue&) const {
  const auto* unsaved = std::get_if<UnsavedDialog>(&state.ui.dialog);
  if (unsaved == nullptr) return;
  const Action next = unsaved->next;
  state.document.discard_changes();
  close_dialog(state);
  apply(state, next);
  // If the next work could not be opened, the current one remains.
  if (!state.done) state.document.keep_changes();
}

void Performer::operator()(const EditExport& edit) const { choose_export(edit.choices); }

void Performer::operator()(const EditPicture& edit) const {
  if (edit.file == state.ui.pictures.file) return;
  state.ui.pictures.file = edit.file;
  state.ui.pictures.problem.clear();
  state.ui.pictures.result.clear();
}

void Performer::operator()(const WriteExport& write) const {
  if (state.ui.shows<PictureDialog>()) return write_picture(state, write.replace);
  write_export(state, write.replace);
}

void Performer::operator()(const CancelExport&) const {
  // A picture and an export may be in progress at once: the open dialog decides which one is
  // cancelled.
  const bool files = state.ui.shows<ExportDialog>() || !state.pictures.busy();
  if (files) return state.exporter.cancel();
  state.pictures.cancel();
}

void Performer::operator()(const ShowExportFolder&) const { show_written_folder(state); }

void Performer::operator()(const ChooseExportFolder&) const {
  const std::string& folder = state.ui.shows<PictureDialog>() ? state.ui.pictures.file.folder
                                                              : state.ui.exporting.choices.folder;
  const auto start = std::filesystem::path(folder) / "";
  if (!open_desktop_dialog(state, FileDialog::Kind::folder, start))
    note(state, Grade::warning,
         "No file dialog is installed (zenity, kdialog): type the name of the folder", kNoteS);
}

void Performer::operator()(const ChooseProcessFile&) const {
  if (!open_desktop_dialog(state, FileDialog::Kind::process, open_folder(state.settings)))
    note(state, Grade::warning,
         "No file dialog is installed (zenity, kdialog): drop a .process.json file on the "
         "window, or open it by name (Ctrl+O)",
         kNoteS);
}

void Performer::operator()(const UseProcess& use) const {
  if (auto process = solid::read_process(use.path.string()); !process)
    return report(state, process.error());
  remember_process(state.settings, use.path);
  (*this)(SetProcess{state.settings.process});
  state.log("process: " + use.path.string());
}

void Performer::operator()(const EditImport& edit) const {
  auto* import = std::get_if<ImportDialog>(&state.ui.dialog);
  if (import == nullptr) return;
  import->settings = edit.settings;
  reload(*import);
}

void Performer::operator()(const TakeImport&) const {
  const auto* import = std::get_if<ImportDialog>(&state.ui.dialog);
  if (import == nullptr || !import->made) return;
  const Pot& pot = import->made->pot;
  apply(state, BeginWork{history::scene_for(pot, name_of_file(import->path.string())),
                         std::make_shared<const Pot>(pot), import->path});
}

void Performer::operator()(const ChooseTarget&) const {
  if (!open_desktop_dialog(state, FileDialog::Kind::target, open_folder(state.settings)))
    state.ui.dialog = OpenDialog{open_folder(state.settings).string(), true};
}

void Performer::operator()(const UseTarget& use) const { set_target(read_target(use.path)); }

void Performer::operator()(const UseSampleTarget& use) const {
  set_target(sample_target(use.index));
}

void Performer::operator()(const ClearTarget&) const { state.ui.target.reset(); }

void Performer::operator()(const ShowWarning& warning) const {
  state.ui.notices.show(Grade::warning, warning.text);
}

void Performer::operator()(const OpenMenu& open) const { state.ui.open_menu = open.index; }

void Performer::operator()(const CloseNotice& close) const {
  if (close.state)
    state.ui.notices.close_state();
  else
    state.ui.notices.close_answer();
}

void Performer::choose_export(const ExportChoices& choices) const {
  ExportState& exporting = state.ui.exporting;
  if (choices == exporting.choices) return;
  exporting.choices = choices;
  exporting.result.clear();
  if (exporting.preview) exporting.problem.clear();  // that of writing
  state.settings.process = choices.process;
}

void Performer::set_target(Result<SharedTarget> target) const {
  if (!target) return report(state, target.error());
  state.ui.target = std::move(*target);
  if (state.document.has_work() && !view_model(state).view_is_held()) show_from(ViewFrom::home);
  if (state.ui.shows<OpenDialog>()) close_dialog(state);
  state.log("target: " + state.ui.target->name);
}

void Performer::back_to_export(const ReplaceDialog& asked) const {
  if (asked.picture)
    state.ui.dialog = PictureDialog{};
  else
    state.ui.dialog = ExportDialog{};
}

}  // namespace clay::studio
