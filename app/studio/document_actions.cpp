// Actions on the work, its file, and the lesson.

#include "app/studio/performer.hpp"

#include "app/history/pot_scene.hpp"
#include "app/studio/commands.hpp"
#include "app/studio/new_scene.hpp"
#include "app/studio/output_dialogs.hpp"
#include "app/studio/page.hpp"
#include "app/studio/panels/panels.hpp"
#include "app/studio/samples.hpp"
#include "claystack/core/atomic_file.hpp"
#include "core/text.hpp"
#include "core/user_folder.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

namespace clay::studio {
namespace {

/// A name without an extension is that of a work.
std::filesystem::path with_extension(std::filesystem::path path) {
  if (path.has_filename() && !path.has_extension()) path += ".work";
  return path;
}

/// A page saves into its storage, even if the file was opened from another folder.
std::filesystem::path save_path(const Settings& settings, const std::filesystem::path& name) {
  const std::filesystem::path path = with_extension(name);
  return kInPage ? std::filesystem::path(settings.folder) / path.filename() : path;
}

/// Folder of a new work. Names are shown with their folder, as for an export; in a page without a
/// folder.
std::filesystem::path save_folder(const Settings& settings) {
  const std::filesystem::path folder = settings.folder;
  return folder.empty() && !kInPage ? current_folder() : folder;
}

/// NAME.work in the folder, or NAME-2.work and so on: the first that is free.
std::filesystem::path unused_name(const std::filesystem::path& folder, const std::string& name) {
  std::error_code ignored;
  for (int n = 1;; ++n) {
    const auto path = folder / (n == 1 ? name + ".work" : fmt::format("{}-{}.work", name, n));
    if (!std::filesystem::exists(path, ignored)) return path;
  }
}

}  // namespace

bool is_process(const std::filesystem::path& path) {
  return ends_ignoring_case(path.string(), ".process.json");
}

void Performer::operator()(const RunCommand& command) const {
  const Command* found = find_command(command.id);
  if (found != nullptr) (void)run(*found, state);
}

void Performer::operator()(const BeginWork& begin) const {
  state.stroke.release();
  const auto begun =
      begin.pot ? state.document.begin(begin.scene, *begin.pot) : state.document.begin(begin.scene);
  if (!succeeded(state, begun)) return;
  state.ui.notices.close_answer();
  if (!begin.source.empty()) remember(state.settings, begin.source);
  show_work();
  if (!begin.source.empty()) state.log("imported: " + begin.source.string());
}

void Performer::operator()(const BeginSample& sample) const {
  auto scene = scene_of(samples().at(sample.index));
  if (!scene) return;
  // The session of the sample was thrown without the options.
  if (scene->clay) scene->clay = history::with_all_options(*scene->clay);
  (*this)(BeginWork{*scene, nullptr, {}});
}

void Performer::operator()(const BeginLesson& lesson) const {
  (*this)(BeginSample{lesson.index});
  start_lesson(lesson.index, lesson.show ? Demonstration::all : Demonstration::none);
}

void Performer::operator()(const YourTurn&) const {
  if (!state.guide.active()) return;
  (*this)(GoToStroke{0});
  start_lesson(state.guide.sample(), Demonstration::none);
}

/// A stroke in progress belongs to the step that ends.
void Performer::operator()(const NextStep&) const {
  if (!state.guide.active()) return;
  const std::size_t step = state.guide.step();
  if (state.stroke.by_hand() || state.stroke.touched()) {
    state.stroke.release();
    state.guide.update(state.document, state.stroke);
  }
  if (state.guide.step() == step) state.guide.next();
}

void Performer::operator()(const ShowStep&) const {
  if (state.guide.active()) state.guide.demonstrate(Demonstration::step);
}

void Performer::operator()(const StopShowing&) const {
  if (state.guide.demonstration() == Demonstration::none) return;
  state.guide.demonstrate(Demonstration::none);
  state.stroke.release();
}

void Performer::operator()(const EndLesson&) const {
  (*this)(StopShowing{});
  state.guide.end();
}

void Performer::operator()(const OpenFile& open) const {
  if (is_process(open.path)) return (*this)(UseProcess{open.path});
  if (is_drawing(open.path)) return open_drawing(open.path);
  state.stroke.release();
  state.ui.notices.close_answer();
  const auto opened = state.document.open(open.path);
  if (!opened) return report_unopened(state, open.path, opened.error());
  if (!opened->empty()) state.ui.notices.show(Grade::warning, *opened);
  remember(state.settings, open.path);
  show_own_wheel();
  show_work();
  state.log("opened: " + open.path.string());
}

void Performer::operator()(const RecoverWork& recover) const {
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

void Performer::operator()(const DiscardRecoverable& discard) const {
  const std::filesystem::path path = state.recoverable.at(discard.index).path;
  if (!discard.confirmed) {
    state.log("prompt: discard");
    state.ui.dialog = DiscardDialog{text_of(state.recoverable[discard.index]),
                                    DiscardRecoverable{discard.index, true}};
    return;
  }
  state.ui.dialog = GalleryDialog{};
  if (!succeeded(state, history::discard(path))) return;
  forget(discard.index);
  state.log("discarded: " + path.string());
}

void Performer::operator()(const DeleteWork& remove) const {
  if (!remove.confirmed) {
    state.log("prompt: delete");
    state.ui.dialog = DiscardDialog{remove.path.filename().string(), DeleteWork{remove.path, true}};
    return;
  }
  if (succeeded(state, delete_work(remove.path))) state.log("deleted: " + remove.path.string());
  forget_if_missing(state.settings, remove.path);
  show_works();
}

void Performer::operator()(const DiscardAsked&) const {
  const auto* asked = std::get_if<DiscardDialog>(&state.ui.dialog);
  if (asked == nullptr) return;
  const Action confirmed = asked->confirmed;  // it closes the dialog
  apply(state, confirmed);
}

void Performer::operator()(const Quit&) const { state.done = true; }

void Performer::operator()(const SaveFile& save) const {
  const std::filesystem::path path = save_path(state.settings, save.path);
  const std::optional<Action> next = after_saving();
  const bool confirmed = save.replace && path.filename() == save.path.filename();
  if (!confirmed && state.document.replaces_other(path)) {
    state.log("prompt: replace");
    const std::string reason = !state.document.has_file(path)
                                   ? " exists. It holds another work or pot."
                               : state.document.file_in_use() ? " is open in another window."
                                                              : " was changed by another program.";
    state.ui.dialog =
        ReplaceDialog{path.filename().string() + reason, SaveDialog{shown_name(path), next}};
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

void Performer::operator()(const ReplaceFiles&) const {
  const auto* asked = std::get_if<ReplaceDialog>(&state.ui.dialog);
  if (asked == nullptr) return;
  if (asked->save) return (*this)(SaveFile{asked->save->path, true});
  back_to_export(*asked);
  (*this)(WriteExport{true});
}

void Performer::operator()(const KeepFiles&) const {
  const auto* asked = std::get_if<ReplaceDialog>(&state.ui.dialog);
  if (asked == nullptr) return;
  if (!asked->save) return back_to_export(*asked);
  Dialog before = *asked->save;
  state.ui.dialog = std::move(before);
}

void Performer::operator()(const Save&) const {
  if (state.document.file().empty())
    ask_for_name(std::nullopt);
  else
    (*this)(SaveFile{state.document.file()});
}

void Performer::operator()(const Undo&) const {
  change_document([](Document& document) { return document.undo(); });
}

void Performer::operator()(const Redo&) const {
  change_document([](Document& document) { return document.redo(); });
}

void Performer::operator()(const GoToStroke& go) const {
  if (go.logged) state.log(fmt::format("timeline: {}", go.node));
  change_document([&](Document& document) { return document.go_to(go.node); });
}

void Performer::operator()(const OtherBranch&) const {
  state.stroke.release();
  if (const auto node = state.document.other_branch()) (*this)(GoToStroke{*node});
}

void Performer::operator()(const Scrub& scrub) const {
  state.stroke.release();
  if (succeeded(state, state.document.scrub(scrub.node, scrub.seconds))) state.stroke.hold_back();
}

void Performer::operator()(const EndScrub&) const {
  const auto& moment = state.document.moment();
  if (!moment) return;
  const bool fingers = state.host.fingers();
  state.log(fmt::format("timeline: {} at {:.3f} s", moment->node, moment->seconds));
  note(state, Grade::note,
       fmt::format("{:.1f} s into stroke {}: {} continues from here as a branch; {} goes back",
                   moment->seconds, moment->node,
                   fingers ? "a press on the clay" : "Ctrl+Shift+B, or a press on the clay,",
                   fingers ? "a tap on its card" : "Esc"),
       8.0);
  state.ui.notices.keep_answer_while([](const Document& document) { return document.scrubbing(); });
}

void Performer::operator()(const BranchHere&) const {
  change_document([](Document& document) { return document.branch_here(); });
}

void Performer::show_work() const {
  state.stroke.begin_work();
  state.guide.end();
  choose(state.document.scene().tool, state.settings.tool);
  state.ui.dialog = NoDialog{};
  show_from(ViewFrom::home);
  state.ui.exporting.written.clear();
  state.ui.exporting.of_other_work = state.exporter.running() == Exporter::Kind::files;
  state.ui.pictures.written.clear();
  state.ui.pictures.of_other_work = state.pictures.busy();
  state.ui.thumbs.clear();
  state.log("work started: " + state.document.scene().name);
}

void Performer::show_own_wheel() const {
  state.settings.wheel_rpm = std::clamp(state.document.wheel_rpm(), kSlowestRpm, kFastestRpm);
}

void Performer::start_lesson(std::size_t sample, Demonstration demonstration) const {
  const auto begun = state.guide.begin(samples().at(sample), demonstration);
  if (!succeeded(state, begun)) return;
  // The verdict of a first pot is that for the usual printer.
  if (state.settings.process.empty()) (*this)(SetProcess{"fdm"});
  state.scene.cut = render::Cut::half;  // the path in the bore is in sight
  state.scene.look(state.stroke.view(), ViewFrom::lesson);
}

std::optional<Action> Performer::after_saving() const {
  if (const auto* save = std::get_if<SaveDialog>(&state.ui.dialog)) return save->next;
  if (const auto* asked = std::get_if<ReplaceDialog>(&state.ui.dialog); asked && asked->save)
    return asked->save->next;
  const auto* unsaved = std::get_if<UnsavedDialog>(&state.ui.dialog);
  return unsaved != nullptr && unsaved->saving ? std::optional(unsaved->next) : std::nullopt;
}

void Performer::forget(std::size_t index) const {
  state.recoverable.erase(state.recoverable.begin() + static_cast<std::ptrdiff_t>(index));
}

void Performer::open_drawing(const std::filesystem::path& path) const {
  auto bytes = read_file(path);
  if (!bytes) return report_unopened(state, path, bytes.error());
  ImportDialog import;
  import.path = path;
  import.bytes = std::move(*bytes);
  reload(import);
  state.ui.dialog = std::move(import);
  state.log("drawing: " + path.string());
}

void Performer::ask_for_name(std::optional<Action> next) const {
  show_present(state);
  const std::filesystem::path path =
      unused_name(save_folder(state.settings), state.document.title());
  if (!open_desktop_dialog(state, FileDialog::Kind::save, path))
    state.ui.dialog = SaveDialog{shown_name(path), std::move(next)};
}

void Performer::show_works() const {
  const std::filesystem::path folder = save_folder(state.settings);
  state.ui.dialog = WorksDialog{folder, stored_works(folder)};
}

}  // namespace clay::studio
