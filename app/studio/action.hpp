#pragma once
// Actions: everything that a user can do in the window, as plain values. Panels, keys, the mouse
// and scripts create them; apply() is the one place that executes them.

#include "app/history/work.hpp"
#include "app/render/painter.hpp"
#include "app/studio/exporter.hpp"
#include "app/studio/importing.hpp"
#include "app/studio/mouse_hand.hpp"
#include "app/studio/picture_writer.hpp"
#include "app/studio/settings.hpp"
#include "app/studio/stroke_controller.hpp"

#include <cstddef>
#include <filesystem>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

namespace clay::studio {

/// A row of the table of commands, by its id (commands.hpp).
struct RunCommand {
  std::string_view id;
};

// --- The document. Those that replace an unsaved work open a question first. ---------------------
/// `pot` null: start with the lump of the scene. `source`: the drawing that the pot was read from,
/// or empty.
struct BeginWork {
  SceneSpec scene;
  history::SharedPot pot;
  std::filesystem::path source;
};
struct BeginSample {
  std::size_t index = 0;  ///< index in samples()
};
/// Begins a sample with the guide through its steps.
struct BeginLesson {
  std::size_t index = 0;  ///< index in samples()
  bool show = false;      ///< plays all strokes first
};
/// The user throws the steps that were shown, from the start.
struct YourTurn {};
struct NextStep {};
/// Plays the stroke of the present step; StopShowing ends it.
struct ShowStep {};
struct StopShowing {};
struct EndLesson {};
/// Opens a scene, a pot or a work. A drawing opens the import dialog; a process file selects that
/// process.
struct OpenFile {
  std::filesystem::path path;
};
struct RecoverWork {
  std::size_t index = 0;  ///< index in AppState::recoverable
};
struct Quit {};
/// Asks first, unless `confirmed`.
struct DiscardRecoverable {
  std::size_t index = 0;
  bool confirmed = false;
};
/// Deletes the file of a work. Asks first, unless `confirmed`.
struct DeleteWork {
  std::filesystem::path path;
  bool confirmed = false;
};
/// The answer to these questions.
struct DiscardAsked {};
/// Completes the extension. Asks first if it would replace another file, unless `replace`.
struct SaveFile {
  std::filesystem::path path;
  bool replace = false;
};
/// Saves to the file of the document, or opens a dialog for a name.
struct Save {};
struct Undo {};
struct Redo {};
struct GoToStroke {
  history::NodeId node = 0;
  bool logged = false;  ///< write it to the log as an event of the timeline
};
struct OtherBranch {};
struct Scrub {
  history::NodeId node = 0;
  double seconds = 0.0;
};
/// The mouse has left the timeline while the view showed a moment in the middle of a stroke.
struct EndScrub {};
struct BranchHere {};

// --- Dialogs. -----------------------------------------------------------------------------------
enum class DialogKind {
  gallery,
  shortcuts,
  settings,
  open_file,
  works,
  save_file,
  export_files,
  picture,
  turntable
};
struct ShowDialog {
  DialogKind kind = DialogKind::gallery;
};
struct CloseDialog {};
struct EditPath {
  std::string path;  ///< in the field of the open or save dialog
};
/// The answer to the question about unsaved changes.
struct SaveAndContinue {};
struct DiscardAndContinue {};
struct EditExport {
  ExportChoices choices;
};
struct EditPicture {
  PictureFile file;
};
/// Writes the files of the open dialog: an export or a picture. Asks first if it would replace
/// files that are not of the last export, unless `replace`.
struct WriteExport {
  bool replace = false;
};
/// The answers to the question about files that would be replaced.
struct ReplaceFiles {};
struct KeepFiles {};
struct CancelExport {};
struct ShowExportFolder {};
struct ChooseExportFolder {};
struct ChooseProcessFile {};
/// Selects a custom process by its file.
struct UseProcess {
  std::filesystem::path path;
};
// The target profile.
struct ChooseTarget {};  ///< opens a dialog for its file
struct UseTarget {
  std::filesystem::path path;
};
struct UseSampleTarget {
  std::size_t index = 0;  ///< index in samples()
};
struct ClearTarget {};
struct EditImport {
  ImportSettings settings;
};
struct TakeImport {};
struct ShowWarning {
  std::string text;
};
struct CloseNotice {
  bool state = false;  ///< the notice of a state; otherwise that of the last answer
};
/// Opens a menu, for the arrow keys.
struct OpenMenu {
  std::size_t index = 0;  ///< in menus()
};

// --- Tool and wheel. ----------------------------------------------------------------------------
struct SetToolMode {
  ToolMode mode = ToolMode::press;
};
/// The next tool that can be used, or the previous one.
struct StepTool {
  int by = 1;
};
struct SetToolShape {
  Shape shape = Shape::sphere;
};
struct ScaleTool {
  double factor = 1.0;
};
struct ChangeGap {
  double by_mm = 0.0;
};
struct SetStiffness {
  double n_per_mm2 = 0.0;
};
/// The mouse sets the size of the tool, or the stiffness, until the next click.
struct DragToolSize {};
struct DragStiffness {};
struct TogglePause {};
/// Re-arms the guard: force ramps up again after the guard held it at zero.
struct Rearm {};
/// Sets the force to zero at once, or returns to the state before.
struct Back {};
struct PressClay {
  MousePress press;
};
struct AimTool {
  MouseAim aim;
  std::optional<double> gap_mm = std::nullopt;  ///< of a pinch
};
struct ReleaseTool {};

// --- The view and the settings. -----------------------------------------------------------------
/// lesson: a little from above, with room for the pot to grow.
enum class ViewFrom { home, front, right, top, lesson };
struct LookFrom {
  ViewFrom from = ViewFrom::home;
};
struct Zoom {
  double notches = 0.0;  ///< positive: nearer
};
struct ToggleCut {
  render::Cut cut = render::Cut::half;
};
/// Unfolds a panel, shows its column and scrolls to it, or folds it.
struct TogglePanel {
  std::string_view id;
};
struct ToggleDiagnostics {};
/// Moves the keyboard focus to the next column of panels, and from the last one back to the view.
struct NextColumn {};
struct FoldPanel {
  std::string_view id;
  bool open = false;
};
struct ToggleTheme {};
struct ScaleText {
  float factor = 1.0f;
};
template <class Field>
struct FieldType;
template <class T>
struct FieldType<T Settings::*> {
  using Type = T;
};
/// Sets one field of the settings.
template <auto Field>
struct Set {
  typename FieldType<decltype(Field)>::Type value;
};
template <bool Settings::*Field>
struct Toggle {};
using SetTheme = Set<&Settings::theme>;
using SetScale = Set<&Settings::scale>;
using SetUnit = Set<&Settings::unit>;
using SetWheelSpeed = Set<&Settings::wheel_rpm>;
using SetTool = Set<&Settings::tool>;
using SetProcess = Set<&Settings::process>;
using SetGoal = Set<&Settings::goal>;
using SetHints = Set<&Settings::hints>;
using SetMaterial = Set<&Settings::material>;
using SetFolder = Set<&Settings::folder>;
using SetBite = Set<&Settings::bite_mm>;
using SetHandSpeed = Set<&Settings::pressing_mm_s>;
using SetWallMap = Set<&Settings::wall_map>;
using SetFullSection = Set<&Settings::full_section>;
using ToggleWallMap = Toggle<&Settings::wall_map>;
using ToggleThrowingLines = Toggle<&Settings::throwing_lines>;
using ToggleHints = Toggle<&Settings::hints>;

using Action = std::variant<
    RunCommand, BeginWork, BeginSample, BeginLesson, YourTurn, NextStep, ShowStep, StopShowing,
    EndLesson, OpenFile, RecoverWork, Quit, DiscardRecoverable, DeleteWork, DiscardAsked, SaveFile,
    Save, Undo, Redo, GoToStroke, OtherBranch, Scrub, EndScrub, BranchHere, ShowDialog, CloseDialog,
    EditPath, SaveAndContinue, DiscardAndContinue, EditExport, WriteExport, ReplaceFiles, KeepFiles,
    CancelExport, ShowExportFolder, ChooseExportFolder, ChooseProcessFile, UseProcess, EditImport,
    TakeImport, ChooseTarget, UseTarget, UseSampleTarget, ClearTarget, SetGoal, ShowWarning,
    CloseNotice, OpenMenu, SetToolMode, StepTool, SetToolShape, ScaleTool, ChangeGap, SetStiffness,
    DragToolSize, DragStiffness, TogglePause, Rearm, Back, PressClay, AimTool, ReleaseTool,
    LookFrom, Zoom, ToggleCut, TogglePanel, ToggleDiagnostics, NextColumn, FoldPanel, ToggleTheme,
    ScaleText, SetTheme, EditPicture, SetMaterial, ToggleThrowingLines, SetScale, SetUnit,
    SetWheelSpeed, SetTool, SetProcess, SetHints, SetFolder, SetHandSpeed, SetBite, SetWallMap,
    SetFullSection, ToggleWallMap, ToggleHints>;

/// In the order of creation.
using Actions = std::vector<Action>;

}  // namespace clay::studio
