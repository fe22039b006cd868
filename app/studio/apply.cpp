// Executes actions.

#include "app/history/pot_scene.hpp"
#include "app/studio/app_state.hpp"
#include "app/studio/commands.hpp"
#include "app/studio/new_scene.hpp"
#include "app/studio/output_dialogs.hpp"
#include "app/studio/panels/panels.hpp"
#include "app/studio/panels/widgets.hpp"
#include "app/studio/samples.hpp"
#include "claystack/core/atomic_file.hpp"
#include "claystack/export/walls.hpp"
#include "core/text.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

namespace clay::studio {
namespace {

constexpr double kGapShareStep = 0.05;
constexpr double kNoteS = 5.0, kSavedNoteS = 4.0;

bool is_process(const std::filesystem::path& path) {
  return ends_ignoring_case(path.string(), ".process.json");
}

/// Text for the log; null: the action does not change the work.
const char* replaces_work(const Action& action) {
  if (std::holds_alternative<Quit>(action)) return "quit";
  if (std::holds_alternative<RecoverWork>(action)) return "recover";
  if (const auto* begin = std::get_if<BeginWork>(&action))
    return begin->source.empty() ? "new" : "import";
  if (std::holds_alternative<BeginSample>(action) || std::holds_alternative<BeginLesson>(action))
    return "new";
  const auto* open = std::get_if<OpenFile>(&action);
  return open != nullptr && !is_process(open->path) && !is_drawing(open->path) ? "open" : nullptr;
}

/// The folder in which dialogs that open a file start: that of the last file.
std::filesystem::path open_folder(const Settings& settings) {
  const std::filesystem::path folder =
      settings.recent.empty() ? std::filesystem::path(settings.folder)
                              : std::filesystem::path(settings.recent.front()).parent_path();
  return folder.empty() ? folder : folder / "";
}

/// Opens the desktop's file dialog, if it is installed. Not used in scripts.
bool open_desktop_dialog(AppState& state, FileDialog::Kind kind,
                         const std::filesystem::path& start) {
  return state.host.real_time() && state.file_dialog.begin(kind, start);
}

/// A name without an extension is that of a work.
std::filesystem::path with_extension(std::filesystem::path path) {
  if (path.has_filename() && !path.has_extension()) path += ".work";
  return path;
}

/// NAME.work in the folder, or NAME-2.work and so on: the first that is free.
std::filesystem::path unused_name(const std::filesystem::path& folder, const std::string& name) {
  std::string stem = std::filesystem::path(name).stem().string();
  if (stem.empty()) stem = "pot";
  std::error_code ignored;
  for (int n = 1;; ++n) {
    const auto path = folder / (n == 1 ? stem + ".work" : fmt::format("{}-{}.work", stem, n));
    if (!std::filesystem::exists(path, ignored)) return path;
  }
}

void close_dialog(AppState& state) {
  if (state.document.has_work())
    state.ui.dialog = NoDialog{};
  else
    state.ui.dialog = GalleryDialog{};
}

/// Executes one action without asking about unsaved changes.
struct Performer {
  AppState& state;

  // --- The document. -----------------------------------------------------------------------------
  void operator()(const RunCommand& command) const {
    const Command* found = find_command(command.id);
    if (found != nullptr) (void)run(*found, state);
  }
  void operator()(const BeginWork& begin) const {
    state.stroke.release();
    const auto begun = begin.pot ? state.document.begin(begin.scene, *begin.pot)
                                 : state.document.begin(begin.scene);
    if (!succeeded(state, begun)) return;
    state.ui.notices.close_answer();
    if (!begin.source.empty()) remember(state.settings, begin.source);
    show_work();
    if (!begin.source.empty()) state.log("imported: " + begin.source.string());
  }
  void operator()(const BeginSample& sample) const {
    auto scene = scene_of(samples().at(sample.index));
    if (!scene) return;
    // New works have a finger; the session of the sample was thrown without one.
    if (scene->clay) scene->clay->finger_mm = history::kFingerMm;
    (*this)(BeginWork{*scene, nullptr, {}});
  }
  void operator()(const BeginLesson& lesson) const {
    (*this)(BeginSample{lesson.index});
    start_lesson(lesson.index, lesson.show ? Demonstration::all : Demonstration::none);
  }
  void operator()(const YourTurn&) const {
    if (!state.guide.active()) return;
    (*this)(GoToStroke{0});
    start_lesson(state.guide.sample(), Demonstration::none);
  }
  void operator()(const NextStep&) const {
    if (state.guide.active()) state.guide.next();
  }
  void operator()(const ShowStep&) const {
    if (state.guide.active()) state.guide.demonstrate(Demonstration::step);
  }
  void operator()(const StopShowing&) const {
    if (state.guide.demonstration() == Demonstration::none) return;
    state.guide.demonstrate(Demonstration::none);
    state.stroke.release();
  }
  void operator()(const EndLesson&) const {
    (*this)(StopShowing{});
    state.guide.end();
  }
  void operator()(const OpenFile& open) const {
    if (is_process(open.path)) return (*this)(UseProcess{open.path});
    if (is_drawing(open.path)) return open_drawing(open.path);
    state.stroke.release();
    state.ui.notices.close_answer();
    const auto opened = state.document.open(open.path);
    if (!opened) return report(state, opened.error());
    if (!opened->empty()) state.ui.notices.show(Grade::warning, *opened);
    remember(state.settings, open.path);
    show_own_wheel();
    show_work();
    state.log("opened: " + open.path.string());
  }
  void operator()(const RecoverWork& recover) const {
    const std::filesystem::path path = state.recoverable.at(recover.index).path;
    state.stroke.release();
    auto work = history::recover(path);
    if (!work) return report(state, work.error());
    forget(recover.index);
    state.document.begin(std::move(*work));
    show_own_wheel();
    show_work();
    state.log("recovered: " + path.string());
  }
  void operator()(const DiscardRecoverable& discard) const {
    const std::filesystem::path path = state.recoverable.at(discard.index).path;
    if (!discard.confirmed) {
      state.log("prompt: discard");
      state.ui.dialog = DiscardDialog{discard.index};
      return;
    }
    state.ui.dialog = GalleryDialog{};
    if (!succeeded(state, history::discard(path))) return;
    forget(discard.index);
    state.log("discarded: " + path.string());
  }
  void operator()(const DiscardAsked&) const {
    if (const auto* asked = std::get_if<DiscardDialog>(&state.ui.dialog))
      (*this)(DiscardRecoverable{asked->index, true});
  }
  void operator()(const Quit&) const { state.done = true; }
  void operator()(const SaveFile& save) const {
    const std::filesystem::path path = with_extension(save.path);
    const std::optional<Action> next = after_saving();
    const bool confirmed = save.replace && path == save.path;
    if (!confirmed && state.document.replaces_other(path)) {
      state.log("prompt: replace");
      const std::string reason =
          !state.document.has_file(path) ? " exists. It holds another work or pot."
          : state.document.file_in_use() ? " is open in another window."
                                         : " was changed by another program.";
      state.ui.dialog =
          ReplaceDialog{path.filename().string() + reason, SaveDialog{path.string(), next}};
      return;
    }
    if (!save_document(state, path)) {
      if (state.ui.shows<ReplaceDialog>()) (*this)(KeepFiles{});
      return;
    }
    close_dialog(state);
    // Not if only a pot was saved, because a pot file keeps no strokes.
    if (next && !state.document.unsaved()) apply(state, *next);
  }
  void operator()(const ReplaceFiles&) const {
    const auto* asked = std::get_if<ReplaceDialog>(&state.ui.dialog);
    if (asked == nullptr) return;
    if (asked->save) return (*this)(SaveFile{asked->save->path, true});
    back_to_export(*asked);
    (*this)(WriteExport{true});
  }
  void operator()(const KeepFiles&) const {
    const auto* asked = std::get_if<ReplaceDialog>(&state.ui.dialog);
    if (asked == nullptr) return;
    if (!asked->save) return back_to_export(*asked);
    Dialog before = *asked->save;
    state.ui.dialog = std::move(before);
  }
  void operator()(const Save&) const {
    if (state.document.file().empty())
      ask_for_name(std::nullopt);
    else
      (*this)(SaveFile{state.document.file()});
  }
  void operator()(const Undo&) const {
    change_document([](Document& document) { return document.undo(); });
  }
  void operator()(const Redo&) const {
    change_document([](Document& document) { return document.redo(); });
  }
  void operator()(const GoToStroke& go) const {
    if (go.logged) state.log(fmt::format("timeline: {}", go.node));
    change_document([&](Document& document) { return document.go_to(go.node); });
  }
  void operator()(const OtherBranch&) const {
    state.stroke.release();
    if (const auto node = state.document.other_branch()) (*this)(GoToStroke{*node});
  }
  void operator()(const Scrub& scrub) const {
    state.stroke.release();
    if (succeeded(state, state.document.scrub(scrub.node, scrub.seconds))) state.stroke.hold_back();
  }
  void operator()(const EndScrub&) const {
    const auto& moment = state.document.moment();
    if (!moment) return;
    state.log(fmt::format("timeline: {} at {:.3f} s", moment->node, moment->seconds));
    note(state, Grade::note,
         fmt::format("{:.1f} s into stroke {}: Ctrl+Shift+B, or a press on the clay, continues "
                     "from here as a branch; Esc goes back",
                     moment->seconds, moment->node),
         8.0);
  }
  void operator()(const BranchHere&) const {
    change_document([](Document& document) { return document.branch_here(); });
  }

  // --- Dialogs. ----------------------------------------------------------------------------------
  void operator()(const ShowDialog& show) const {
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
  void operator()(const CloseDialog&) const {
    if (state.ui.shows<ReplaceDialog>()) return (*this)(KeepFiles{});
    if (state.ui.shows<DiscardDialog>()) {
      state.ui.dialog = GalleryDialog{};
      return;
    }
    close_dialog(state);
  }
  void operator()(const EditPath& edit) const {
    if (auto* open = std::get_if<OpenDialog>(&state.ui.dialog)) open->path = edit.path;
    if (auto* save = std::get_if<SaveDialog>(&state.ui.dialog)) save->path = edit.path;
  }
  void operator()(const SaveAndContinue&) const {
    auto* unsaved = std::get_if<UnsavedDialog>(&state.ui.dialog);
    if (unsaved == nullptr) return;
    unsaved->saving = true;
    if (state.document.file().empty())
      ask_for_name(unsaved->next);
    else
      (*this)(SaveFile{state.document.file()});
  }
  void operator()(const DiscardAndContinue&) const {
    const auto* unsaved = std::get_if<UnsavedDialog>(&state.ui.dialog);
    if (unsaved == nullptr) return;
    const Action next = unsaved->next;
    state.document.discard_changes();
    close_dialog(state);
    apply(state, next);
    // If the next work could not be opened, the current one remains.
    if (!state.done) state.document.keep_changes();
  }
  void operator()(const EditExport& edit) const { choose_export(edit.choices); }
  void operator()(const EditPicture& edit) const {
    if (edit.file == state.ui.pictures.file) return;
    state.ui.pictures.file = edit.file;
    state.ui.pictures.problem.clear();
    state.ui.pictures.result.clear();
  }
  void operator()(const WriteExport& write) const {
    if (state.ui.shows<PictureDialog>()) return write_picture(state, write.replace);
    write_export(state, write.replace);
  }
  void operator()(const CancelExport&) const {
    if (state.pictures.busy()) return state.pictures.cancel();
    state.exporter.cancel();
  }
  void operator()(const ShowExportFolder&) const { show_written_folder(state); }
  void operator()(const ChooseExportFolder&) const {
    const std::string& folder = state.ui.shows<PictureDialog>() ? state.ui.pictures.file.folder
                                                                : state.ui.exporting.choices.folder;
    const auto start = std::filesystem::path(folder) / "";
    if (!open_desktop_dialog(state, FileDialog::Kind::folder, start))
      note(state, Grade::warning,
           "No file dialog is installed (zenity, kdialog): type the name of the folder", kNoteS);
  }
  void operator()(const ChooseProcessFile&) const {
    if (!open_desktop_dialog(state, FileDialog::Kind::process, open_folder(state.settings)))
      note(state, Grade::warning,
           "No file dialog is installed (zenity, kdialog): drop a .process.json file on the "
           "window, or open it by name (Ctrl+O)",
           kNoteS);
  }
  /// Sets the process of a file.
  void operator()(const UseProcess& use) const {
    if (auto process = solid::read_process(use.path.string()); !process)
      return report(state, process.error());
    remember_process(state.settings, use.path);
    (*this)(SetProcess{state.settings.process});
    state.log("process: " + use.path.string());
  }
  void operator()(const EditImport& edit) const {
    auto* import = std::get_if<ImportDialog>(&state.ui.dialog);
    if (import == nullptr) return;
    import->settings = edit.settings;
    reload(*import);
  }
  void operator()(const TakeImport&) const {
    const auto* import = std::get_if<ImportDialog>(&state.ui.dialog);
    if (import == nullptr || !import->made) return;
    const Pot& pot = import->made->pot;
    apply(state, BeginWork{history::scene_for(pot, import->path.stem().string()),
                           std::make_shared<const Pot>(pot), import->path});
  }
  void operator()(const ChooseTarget&) const {
    if (!open_desktop_dialog(state, FileDialog::Kind::target, open_folder(state.settings)))
      state.ui.dialog = OpenDialog{open_folder(state.settings).string(), true};
  }
  void operator()(const UseTarget& use) const { set_target(read_target(use.path)); }
  void operator()(const UseSampleTarget& use) const { set_target(sample_target(use.index)); }
  void operator()(const ClearTarget&) const { state.ui.target.reset(); }
  void operator()(const ShowWarning& warning) const {
    state.ui.notices.show(Grade::warning, warning.text);
  }
  void operator()(const OpenMenu& open) const { state.ui.open_menu = open.index; }
  void operator()(const CloseNotice& close) const {
    if (close.state)
      state.ui.notices.close_state();
    else
      state.ui.notices.close_answer();
  }

  // --- Tool and wheel. ---------------------------------------------------------------------------
  void operator()(const SetToolMode& set) const {
    state.settings.tool.mode = set.mode;
    if (set.mode == ToolMode::pinch && state.document.has_work() && !state.stroke.throwing())
      state.scene.keep_rim_in_view(state.stroke.view(), set.mode);
  }
  void operator()(const StepTool& step) const {
    const ViewModel view = view_model(state);
    std::vector<const Command*> tools;
    std::size_t chosen = 0;
    for (const Command& command : commands()) {
      if (!std::holds_alternative<SetToolMode>(command.action) || !command.enabled(view)) continue;
      if (command.checked(view)) chosen = tools.size();
      tools.push_back(&command);
    }
    const std::size_t count = tools.size();
    (*this)(RunCommand{tools[(chosen + count + static_cast<std::size_t>(step.by)) % count]->id});
  }
  void operator()(const SetToolShape& set) const { state.settings.tool.shape = set.shape; }
  void operator()(const ScaleTool& scale) const { resize(state.settings.tool, scale.factor); }
  void operator()(const ChangeGap& change) const {
    double& gap_mm = state.settings.tool.gap_mm;
    if (double& share = state.settings.tool.gap_share; share > 0.0) {
      share = std::clamp(share + std::copysign(kGapShareStep, change.by_mm), kLeastGapShare,
                         kMostGapShare);
      return;
    }
    gap_mm = std::clamp(gap_mm + change.by_mm, kNarrowestGapMm, kWidestPinchMm);
  }
  void operator()(const SetStiffness& set) const { state.document.set_stiffness(set.n_per_mm2); }
  void operator()(const DragToolSize&) const { state.scene.drag_size(view_model(state)); }
  void operator()(const DragStiffness&) const { state.scene.drag_stiffness(view_model(state)); }
  void operator()(const TogglePause&) const { state.stroke.pause(!state.stroke.paused()); }
  void operator()(const Rearm&) const { state.stroke.command({servo::CommandKind::rearm, 0.0}); }
  /// Pressing Esc repeatedly never restores force.
  void operator()(const Back&) const {
    const bool force =
        state.stroke.has_device() && state.document.has_work() && !state.stroke.paused();
    if (force) state.stroke.pause(true);
    if (state.scene.setting()) {
      Actions undone;
      state.scene.cancel(undone);
      return apply_all(state, undone);
    }
    if (!state.ui.shows<NoDialog>()) return (*this)(CloseDialog{});
    if (state.document.scrubbing())
      return change_document([](Document& document) { return document.show_present(); });
    if (state.guide.demonstration() != Demonstration::none) return (*this)(StopShowing{});
    if (state.stroke.throwing() && !state.stroke.has_device()) return state.stroke.release();
    if (!force) (*this)(CloseNotice{!state.ui.notices.answer()});
  }
  void operator()(const PressClay& press) const {
    if (succeeded(state, state.stroke.press(press.press)))
      state.log("stroke started");
    else
      state.scene.stop_shaping();
  }
  void operator()(const AimTool& aim) const {
    state.stroke.aim(aim.aim);
    if (aim.gap_mm) state.stroke.close_to(*aim.gap_mm);
  }
  void operator()(const ReleaseTool&) const { state.stroke.release(); }

  // --- The view and the settings. ----------------------------------------------------------------
  void operator()(const LookFrom& look) const { show_from(look.from); }
  void operator()(const Zoom& zoom) const { state.scene.zoom(zoom.notches); }
  void operator()(const ToggleCut& toggle) const {
    state.scene.cut = state.scene.cut == toggle.cut ? render::Cut::none : toggle.cut;
  }
  void operator()(const TogglePanel& toggle) const {
    const bool open = !panel_open(state.settings, toggle.id);
    state.settings.open[std::string(toggle.id)] = open;
    if (open && in_diagnostics(toggle.id)) state.settings.open[kDiagnostics] = true;
    state.ui.reveal = open ? toggle.id : std::string_view();
  }
  void operator()(const ToggleDiagnostics&) const {
    state.settings.open[kDiagnostics] = !diagnostics_open(state.settings);
  }
  void operator()(const FoldPanel& fold) const {
    state.settings.open[std::string(fold.id)] = fold.open;
    state.ui.reveal = fold.open ? fold.id : std::string_view();
  }
  void operator()(const ToggleTheme&) const {
    (*this)(SetTheme{state.settings.theme == Theme::dark ? Theme::light : Theme::dark});
  }
  void operator()(const ScaleText& scale) const {
    (*this)(
        SetScale{std::clamp(state.settings.scale * scale.factor, kSmallestScale, kLargestScale)});
  }
  template <auto Field>
  void operator()(const Set<Field>& set) const {
    state.settings.*Field = set.value;
  }
  /// The walls and the export have the same process.
  void operator()(const SetProcess& set) const {
    state.settings.process = set.value;
    ExportChoices choices = state.ui.exporting.choices;
    choices.process = set.value;
    choose_export(choices);
  }
  void operator()(const SetTheme& set) const {
    state.settings.theme = set.value;
    state.ui.restyle = true;
  }
  void operator()(const SetScale& set) const {
    state.settings.scale = set.value;
    state.ui.restyle = true;
  }
  template <bool Settings::*Field>
  void operator()(const Toggle<Field>&) const {
    state.settings.*Field = !(state.settings.*Field);
  }

 private:
  /// The result is that of other choices.
  void choose_export(const ExportChoices& choices) const {
    ExportState& exporting = state.ui.exporting;
    if (choices == exporting.choices) return;
    exporting.choices = choices;
    exporting.result.clear();
    if (exporting.preview) exporting.problem.clear();  // that of writing
    state.settings.process = choices.process;
  }
  template <class Change>
  void change_document(Change change) const {
    state.stroke.release();
    (void)succeeded(state, change(state.document));
    state.stroke.resume();
  }
  /// After a new work has begun: selects its tool and shows it in the view.
  void show_work() const {
    state.stroke.begin_work();
    state.guide.end();
    choose(state.document.scene().tool, state.settings.tool);
    state.ui.dialog = NoDialog{};
    show_from(ViewFrom::home);
    state.ui.exporting.written.clear();
    state.ui.thumbs.clear();
    state.log("work started: " + state.document.scene().name);
  }
  /// A work from a file continues at its stored speed of the wheel, so that the same stroke gives
  /// the same pot.
  void show_own_wheel() const {
    state.settings.wheel_rpm = std::clamp(state.document.wheel_rpm(), kSlowestRpm, kFastestRpm);
  }
  void start_lesson(std::size_t sample, Demonstration demonstration) const {
    const auto begun = state.guide.begin(samples().at(sample), demonstration);
    if (!succeeded(state, begun)) return;
    // The verdict of a first pot is that for the usual printer.
    if (state.settings.process.empty()) (*this)(SetProcess{"fdm"});
    state.scene.cut = render::Cut::half;  // the path in the bore is in sight
    state.scene.look(state.stroke.view(), ViewFrom::lesson);
  }
  /// The action to run after saving.
  [[nodiscard]] std::optional<Action> after_saving() const {
    if (const auto* save = std::get_if<SaveDialog>(&state.ui.dialog)) return save->next;
    if (const auto* asked = std::get_if<ReplaceDialog>(&state.ui.dialog); asked && asked->save)
      return asked->save->next;
    const auto* unsaved = std::get_if<UnsavedDialog>(&state.ui.dialog);
    return unsaved != nullptr && unsaved->saving ? std::optional(unsaved->next) : std::nullopt;
  }
  /// The pot, and the target if that is higher.
  void show_from(ViewFrom from) const {
    const render::PotView& pot = state.stroke.view();
    const Target* target = state.ui.target.get();
    state.scene.look(
        target != nullptr && target->view.height_mm > pot.height_mm ? target->view : pot, from);
  }
  void set_target(Result<SharedTarget> target) const {
    if (!target) return report(state, target.error());
    state.ui.target = std::move(*target);
    if (state.document.has_work()) show_from(ViewFrom::home);
    if (state.ui.shows<OpenDialog>()) close_dialog(state);
    state.log("target: " + state.ui.target->name);
  }
  void forget(std::size_t index) const {
    state.recoverable.erase(state.recoverable.begin() + static_cast<std::ptrdiff_t>(index));
  }
  void open_drawing(const std::filesystem::path& path) const {
    auto bytes = read_file(path);
    if (!bytes) return report(state, bytes.error());
    ImportDialog import;
    import.path = path;
    import.bytes = std::move(*bytes);
    reload(import);
    state.ui.dialog = std::move(import);
    state.log("drawing: " + path.string());
  }
  void ask_for_name(std::optional<Action> next) const {
    // The name is shown with its folder, as for an export; a page has no folders.
    std::filesystem::path folder = state.settings.folder;
    if (folder.empty() && !kInPage) folder = std::filesystem::current_path();
    const std::filesystem::path path = unused_name(folder, state.document.name());
    if (!open_desktop_dialog(state, FileDialog::Kind::save, path))
      state.ui.dialog = SaveDialog{path.string(), std::move(next)};
  }
  void back_to_export(const ReplaceDialog& asked) const {
    if (asked.picture)
      state.ui.dialog = PictureDialog{};
    else
      state.ui.dialog = ExportDialog{};
  }
};

}  // namespace

void apply(AppState& state, const Action& action) {
  if (const char* reason = replaces_work(action)) {
    state.stroke.release();
    if (state.document.unsaved()) {
      // A file that cannot be opened replaces nothing.
      if (const auto* open = std::get_if<OpenFile>(&action))
        if (const auto read = Document::read(open->path); !read) return report(state, read.error());
      state.ui.dialog = UnsavedDialog{action};
      state.log(std::string("prompt: ").append(reason));
      return;
    }
  }
  std::visit(Performer{state}, action);
}

bool save_document(AppState& state, const std::filesystem::path& path) {
  state.stroke.release();
  if (!succeeded(state, state.document.save(path))) return false;
  remember(state.settings, path);
  state.settings.folder =
      std::filesystem::path(state.settings.recent.front()).parent_path().string();
  state.host.file_written(path.string());
  state.log("saved: " + path.string());
  note(state, Grade::note, "Saved " + path.string(), kSavedNoteS);
  return true;
}

void apply_all(AppState& state, Actions& actions) {
  for (const Action& action : std::exchange(actions, {})) apply(state, action);
}

}  // namespace clay::studio
