// Executes actions, and asks first about unsaved changes.

#include "app/studio/page.hpp"
#include "app/studio/performer.hpp"

#include <filesystem>
#include <string>
#include <utility>
#include <variant>

namespace clay::studio {
namespace {

constexpr double kSavedNoteS = 4.0;

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

/// An export that ended with the program would leave no file. Shows its progress instead.
bool waits_for_export(AppState& state) {
  const bool picture = state.pictures.busy();
  if (!picture && state.exporter.running() != Exporter::Kind::files) return false;
  if (picture)
    state.ui.dialog = PictureDialog{};
  else if (!state.ui.shows<ExportDialog>())
    state.ui.dialog = ExportDialog{};
  state.ui.notices.show(Grade::warning,
                        "An export is in progress. Quit when it has ended, or cancel it first");
  state.log("prompt: export");
  return true;
}

}  // namespace

void apply(AppState& state, const Action& action) {
  if (std::holds_alternative<Quit>(action) && waits_for_export(state)) return;
  if (const char* reason = replaces_work(action)) {
    state.stroke.release();
    if (state.document.unsaved()) {
      // A file that cannot be opened replaces nothing.
      if (const auto* open = std::get_if<OpenFile>(&action))
        if (const auto read = Document::read(open->path); !read)
          return report_unopened(state, open->path, read.error());
      UnsavedDialog question{action};
      if (auto* import = std::get_if<ImportDialog>(&state.ui.dialog))
        question.import = std::move(*import);
      state.ui.dialog = std::move(question);
      state.log(std::string("prompt: ").append(reason));
      return;
    }
  }
  std::visit(Performer{state}, action);
}

void report_unopened(AppState& state, const std::filesystem::path& path, const Error& error) {
  forget_if_missing(state.settings, path);
  report(state, error);
}

bool save_document(AppState& state, const std::filesystem::path& path) {
  show_present(state);
  if (!succeeded(state, state.document.save(path))) return false;
  remember(state.settings, path);
  state.settings.folder =
      std::filesystem::path(state.settings.recent.front()).parent_path().string();
  state.host.file_written(path.string());
  state.log("saved: " + path.string());
  note(state, Grade::note, "Saved " + shown_name(path), kSavedNoteS);
  return true;
}

void apply_all(AppState& state, Actions& actions) {
  for (const Action& action : std::exchange(actions, {})) apply(state, action);
}

}  // namespace clay::studio
