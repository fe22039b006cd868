#pragma once
// Executes one action without asking about unsaved changes. Its members are defined in
// document_actions.cpp, dialog_actions.cpp, tool_actions.cpp and view_actions.cpp.

#include "app/studio/app_state.hpp"

#include <cstddef>
#include <filesystem>
#include <optional>

namespace clay::studio {

struct Performer {
  AppState& state;

  // The document.
  void operator()(const RunCommand& command) const;
  void operator()(const BeginWork& begin) const;
  void operator()(const BeginSample& sample) const;
  void operator()(const BeginLesson& lesson) const;
  void operator()(const YourTurn&) const;
  void operator()(const NextStep&) const;
  void operator()(const ShowStep&) const;
  void operator()(const StopShowing&) const;
  void operator()(const EndLesson&) const;
  void operator()(const OpenFile& open) const;
  void operator()(const RecoverWork& recover) const;
  void operator()(const DiscardRecoverable& discard) const;
  void operator()(const DeleteWork& remove) const;
  void operator()(const DiscardAsked&) const;
  void operator()(const Quit&) const;
  void operator()(const SaveFile& save) const;
  void operator()(const ReplaceFiles&) const;
  void operator()(const KeepFiles&) const;
  void operator()(const Save&) const;
  void operator()(const Undo&) const;
  void operator()(const Redo&) const;
  void operator()(const GoToStroke& go) const;
  void operator()(const OtherBranch&) const;
  void operator()(const Scrub& scrub) const;
  void operator()(const EndScrub&) const;
  void operator()(const BranchHere&) const;

  // Dialogs and notices.
  void operator()(const ShowDialog& show) const;
  void operator()(const CloseDialog&) const;
  void operator()(const EditPath& edit) const;
  void operator()(const SaveAndContinue&) const;
  void operator()(const DiscardAndContinue&) const;
  void operator()(const EditExport& edit) const;
  void operator()(const EditPicture& edit) const;
  void operator()(const WriteExport& write) const;
  void operator()(const CancelExport&) const;
  void operator()(const ShowExportFolder&) const;
  void operator()(const ChooseExportFolder&) const;
  void operator()(const ChooseProcessFile&) const;
  /// Sets the process of a file.
  void operator()(const UseProcess& use) const;
  void operator()(const EditImport& edit) const;
  void operator()(const TakeImport&) const;
  void operator()(const ChooseTarget&) const;
  void operator()(const UseTarget& use) const;
  void operator()(const UseSampleTarget& use) const;
  void operator()(const ClearTarget&) const;
  void operator()(const ShowWarning& warning) const;
  void operator()(const OpenMenu& open) const;
  void operator()(const CloseNotice& close) const;

  // Tool and wheel.
  void operator()(const SetToolMode& set) const;
  void operator()(const StepTool& step) const;
  void operator()(const SetToolShape& set) const;
  void operator()(const ScaleTool& scale) const;
  void operator()(const ChangeGap& change) const;
  void operator()(const SetStiffness& set) const;
  void operator()(const DragToolSize&) const;
  void operator()(const DragStiffness&) const;
  void operator()(const TogglePause&) const;
  void operator()(const Rearm&) const;
  /// Esc never restores force, even if pressed repeatedly.
  void operator()(const Back&) const;
  void operator()(const PressClay& press) const;
  void operator()(const AimTool& aim) const;
  void operator()(const ReleaseTool&) const;

  // The view and the settings.
  void operator()(const LookFrom& look) const;
  void operator()(const Zoom& zoom) const;
  void operator()(const ToggleCut& toggle) const;
  void operator()(const TogglePanel& toggle) const;
  void operator()(const ToggleDiagnostics&) const;
  void operator()(const NextColumn&) const;
  void operator()(const FoldPanel& fold) const;
  void operator()(const ToggleTheme&) const;
  void operator()(const ScaleText& scale) const;
  template <auto Field>
  void operator()(const Set<Field>& set) const {
    state.settings.*Field = set.value;
  }
  /// The walls and the export have the same process.
  void operator()(const SetProcess& set) const;
  void operator()(const SetTheme& set) const;
  void operator()(const SetScale& set) const;
  template <bool Settings::*Field>
  void operator()(const Toggle<Field>&) const {
    state.settings.*Field = !(state.settings.*Field);
  }

 private:
  /// Changed choices; clears the result, which is that of the old ones.
  void choose_export(const ExportChoices& choices) const;
  template <class Change>
  void change_document(Change change) const {
    state.stroke.release();
    const render::Extent before = render::extent_of(state.stroke.view());
    (void)succeeded(state, change(state.document));
    state.scene.follow(state.stroke.view(), before, state.settings.tool.mode);
    state.stroke.resume();
  }
  /// After a new work has begun: selects its tool and shows it in the view.
  void show_work() const;
  /// A work from a file continues at its stored speed of the wheel, so that the same stroke gives
  /// the same pot.
  void show_own_wheel() const;
  void start_lesson(std::size_t sample, Demonstration demonstration) const;
  /// The action to run after saving.
  [[nodiscard]] std::optional<Action> after_saving() const;
  /// The column of panels, where it has no room beside the view.
  void show_context() const;
  /// The pot, and the target if that is higher.
  void show_from(ViewFrom from) const;
  void set_target(Result<SharedTarget> target) const;
  void forget(std::size_t index) const;
  void open_drawing(const std::filesystem::path& path) const;
  void ask_for_name(std::optional<Action> next) const;
  void show_works() const;
  void back_to_export(const ReplaceDialog& asked) const;
};

/// Closes the dialog; without a work, the gallery is shown.
void close_dialog(AppState& state);
/// The folder in which dialogs that open a file start: that of the last file.
[[nodiscard]] std::filesystem::path open_folder(const Settings& settings);
/// Opens the desktop's file dialog, if it is installed and none is open. False: not installed, or
/// in a script.
bool open_desktop_dialog(AppState& state, FileDialog::Kind kind,
                         const std::filesystem::path& start);
[[nodiscard]] bool is_process(const std::filesystem::path& path);

}  // namespace clay::studio
