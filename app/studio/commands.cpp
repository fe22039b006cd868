#include "app/studio/commands.hpp"

#include "app/studio/app_state.hpp"
#include "app/studio/page.hpp"
#include "app/studio/panels/panels.hpp"

#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>

#include <fmt/format.h>

#include <algorithm>
#include <array>

namespace clay::studio {
namespace {

constexpr double kSizeStep = 1.1, kGapStepMm = 0.5;
constexpr float kTextStep = 1.1f;

using View = const ViewModel&;

constexpr std::string_view kGoal = "goal", kSection = "section", kWalls = "walls",
                           kCertificate = "certificate", kLedger = "ledger", kStress = "stress",
                           kServo = "servo";

bool always(View) { return true; }
bool in_lesson(View view) { return view.guide.active(); }
bool in_step(View view) {
  return view.guide.active() && !view.guide.finished() && !view.readings.fallen();
}
bool can_show_step(View view) { return in_step(view) && !view.stroke.has_device(); }
bool has_work(View view) { return view.document.has_work(); }
bool view_is_free(View view) { return !view.view_is_held(); }
/// A panel that is not visible takes room from the view when it unfolds.
bool can_unfold(View view) { return view.ui.context_shown || view_is_free(view); }
bool can_look(View view) { return has_work(view) && view_is_free(view); }
bool at_rest(View view) { return view.at_rest(); }
/// A finger is not over the view while it is lifted.
bool can_drag(View view) { return at_rest(view) && !view.fingers; }
bool between(View view) { return view.between_strokes(); }

/// The current stroke of a device counts as well: undo ends it first.
bool can_undo(View view) {
  const bool current = view.stroke.throwing() && view.stroke.status().poses > 0;
  return view.between_strokes() && (view.document.can_undo() || current);
}
bool can_redo(View view) { return view.between_strokes() && view.document.can_redo(); }
bool can_switch(View view) {
  return view.between_strokes() && view.document.other_branch().has_value();
}
bool scrubbing(View view) { return view.document.scrubbing(); }
bool asks(View view) { return view.ui.shows<UnsavedDialog>(); }
bool asks_to_replace(View view) { return view.ui.shows<ReplaceDialog>(); }
bool asks_to_discard(View view) { return view.ui.shows<DiscardDialog>(); }
bool recoverable(View view) { return !view.recoverable.empty(); }
const char* why_no_file_name(const std::string& name) {
  return name.empty() ? "the files need a name"
         : name.find('/') != std::string::npos
             ? "a name cannot contain \"/\": choose the folder below"
             : nullptr;
}
const char* why_no_write(View view) {
  if (view.ui.shows<PictureDialog>())
    return view.picture_running ? "a picture is being written"
                                : why_no_file_name(view.ui.pictures.file.name);
  if (!view.ui.shows<ExportDialog>()) return "no export dialog is open";
  if (view.writing()) return "an export is in progress";
  const ExportChoices& choices = view.ui.exporting.choices;
  if (const char* why = why_no_file_name(choices.name)) return why;
  if (paths_of(choices).empty()) return "no file is chosen";
  return view.ui.exporting.refused ? "these files cannot be exported" : nullptr;
}
bool can_write(View view) { return why_no_write(view) == nullptr; }
bool can_cancel(View view) {
  return view.writing() || (view.picture_running && !view.ui.shows<ExportDialog>());
}
bool has_written(View view) {
  return view.ui.shows<PictureDialog>() ? !view.ui.pictures.written.empty()
                                        : !view.ui.exporting.written.empty();
}
bool can_draw(View view) { return view.between_strokes() && PictureWriter::available(); }
const char* why_no_undo(View view) {
  return can_undo(view) ? nullptr : "there is no stroke to undo";
}
const char* why_no_redo(View view) { return can_redo(view) ? nullptr : "no stroke was undone"; }
const char* why_no_work(View view) {
  return has_work(view) ? nullptr : "there is no clay on the wheel";
}
const char* why_not_between(View view) {
  return between(view)       ? nullptr
         : why_no_work(view) ? why_no_work(view)
                             : "a stroke is in progress";
}
const char* why_view_is_held(View view) {
  return view_is_free(view) ? nullptr : "the view stands still while the tool follows the pointer";
}
const char* why_not_unfold(View view) {
  return can_unfold(view) ? nullptr : why_view_is_held(view);
}
const char* why_no_look(View view) {
  return has_work(view) ? why_view_is_held(view) : why_no_work(view);
}
const char* why_no_pictures(View view) {
  return PictureWriter::available() ? why_not_between(view)
                                    : "a web page cannot write pictures; open the pot in the "
                                      "program for the desktop";
}
/// A page has no command to quit: it runs until its tab is closed.
bool can_quit(View) { return !kInPage; }
const char* why_no_quit(View view) {
  return can_quit(view) ? nullptr : "a page ends when its tab is closed";
}
const char* why_no_show(View view) {
  return can_show_step(view)        ? nullptr
         : view.stroke.has_device() ? "an arm holds the tool"
                                    : "no step of a lesson is in progress";
}
bool can_import(View view) {
  const auto* import = std::get_if<ImportDialog>(&view.ui.dialog);
  return import != nullptr && import->made;
}
/// Smoothing is a clay rule; works thrown without the rules have none.
bool has_rules(View view) {
  return view.document.has_work() && view.document.scene().clay.has_value();
}
const char* why_no_rules(View view) {
  return !has_work(view)   ? why_no_work(view)
         : has_rules(view) ? nullptr
                           : "this tool needs a pot thrown with the clay rules";
}
const char* why_no_drag(View view) {
  if (can_drag(view)) return nullptr;
  return view.fingers               ? "this needs a mouse; the panels have sliders"
         : view.stroke.has_device() ? "an arm holds the tool; the panels have sliders"
                                    : why_not_between(view);
}
bool pinching(View view) { return view.settings.tool.mode == ToolMode::pinch; }
bool rearmable(View view) { return view.waits_for_rearm(); }

template <ToolMode mode>
bool is_mode(View view) {
  return view.settings.tool.mode == mode;
}
template <Shape shape>
bool is_shape(View view) {
  return view.settings.tool.shape == shape;
}
template <render::Cut cut>
bool is_cut(View view) {
  return view.scene.cut == cut;
}
template <LengthUnit unit>
bool is_unit(View view) {
  return view.settings.unit == unit;
}
template <const std::string_view& id>
bool is_open(View view) {
  return panel_open(view.settings, view.ui, id);
}
bool has_target(View view) { return view.ui.target != nullptr; }
bool paused(View view) { return view.stroke.paused(); }
bool is_light(View view) { return view.settings.theme == Theme::light; }
bool has_wall_map(View view) { return view.settings.wall_map; }
bool has_throwing_lines(View view) { return view.settings.throwing_lines; }
bool has_diagnostics(View view) { return diagnostics_open(view.settings); }
bool can_go_to_panels(View view) { return view.ui.shows<NoDialog>() && view_is_free(view); }
bool has_keys_in_panels(View view) { return view.ui.keys_in.has_value(); }
bool has_hints(View view) { return view.settings.hints; }

constexpr unsigned kCtrl = kControl, kCtrlShift = kControl | kShift;
constexpr KeyChord kNone{};
constexpr KeyChord key(int code, unsigned mods = kNoMods) { return {code, mods}; }

using C = Command;
using Kind = DialogKind;

// clang-format off
const std::array kCommands = {
    C{"file.new", "New...", key(GLFW_KEY_N, kCtrl), kNone, ShowDialog{Kind::gallery}, between},
    C{"file.new_bowl", "Throw a bowl", kNone, kNone, BeginSample{0}, always},
    C{"file.new_vase", "Throw a vase", kNone, kNone, BeginSample{1}, always},
    C{"file.new_bottle", "Throw a bottle", kNone, kNone, BeginSample{2}, always},
    C{"file.new_cylinder", "Throw a cylinder", kNone, kNone, BeginSample{3}, always},
    C{"file.learn_bowl", "Throw a bowl step by step", kNone, kNone, BeginLesson{0, false}, always},
    C{"file.learn_vase", "Throw a vase step by step", kNone, kNone, BeginLesson{1, false}, always},
    C{"file.learn_bottle", "Throw a bottle step by step", kNone, kNone, BeginLesson{2, false}, always},
    C{"file.learn_cylinder", "Throw a cylinder step by step", kNone, kNone, BeginLesson{3, false}, always},
    C{"file.open", "Open...", key(GLFW_KEY_O, kCtrl), kNone, ShowDialog{Kind::open_file}, always},
    C{"file.works", "Works...", kNone, kNone, ShowDialog{Kind::works}, always},
    C{"file.save", "Save", key(GLFW_KEY_S, kCtrl), kNone, Save{}, between, nullptr, why_not_between},
    C{"file.save_as", "Save as...", key(GLFW_KEY_S, kCtrlShift), kNone, ShowDialog{Kind::save_file}, between},
    C{"file.export", "Export...", key(GLFW_KEY_E, kCtrl), kNone, ShowDialog{Kind::export_files}, between, nullptr, why_not_between},
    C{"file.picture", "Export picture...", key(GLFW_KEY_E, kCtrlShift), kNone, ShowDialog{Kind::picture}, can_draw, nullptr, why_no_pictures},
    C{"file.turntable", "Export turntable...", kNone, kNone, ShowDialog{Kind::turntable}, can_draw, nullptr, why_no_pictures},
    C{"file.settings", "Settings...", key(GLFW_KEY_COMMA, kCtrl), kNone, ShowDialog{Kind::settings}, always},
    C{"file.quit", "Quit", key(GLFW_KEY_Q, kCtrl), kNone, Quit{}, can_quit, nullptr, why_no_quit},

    C{"edit.undo", "Undo stroke", key(GLFW_KEY_Z, kCtrl), kNone, Undo{}, can_undo, nullptr, why_no_undo},
    C{"edit.redo", "Redo stroke", key(GLFW_KEY_Z, kCtrlShift), key(GLFW_KEY_Y, kCtrl), Redo{}, can_redo, nullptr, why_no_redo},
    C{"edit.to_start", "Go to the start", key(GLFW_KEY_HOME, kCtrl), kNone, GoToStroke{0}, can_undo},
    C{"edit.other_branch", "Switch branch", key(GLFW_KEY_B, kCtrl), kNone, OtherBranch{}, can_switch},
    C{"edit.branch", "Branch at this moment", key(GLFW_KEY_B, kCtrlShift), kNone, BranchHere{}, scrubbing},

    // Used in dialogs; not in a menu.
    C{"quit.save", "Save first", key(GLFW_KEY_ENTER), kNone, SaveAndContinue{}, asks},
    C{"quit.discard", "Discard changes", key(GLFW_KEY_D, kCtrl), kNone, DiscardAndContinue{}, asks},
    C{"quit.cancel", "Cancel", kNone, kNone, CloseDialog{}, asks},
    C{"replace.confirm", "Replace", key(GLFW_KEY_R, kCtrlShift), kNone, ReplaceFiles{}, asks_to_replace},
    C{"replace.cancel", "Cancel", kNone, kNone, KeepFiles{}, asks_to_replace},
    C{"recover.take", "Recover the unsaved work", key(GLFW_KEY_R, kCtrl), kNone, RecoverWork{0}, recoverable},
    C{"recover.discard", "Discard the unsaved work", kNone, kNone, DiscardRecoverable{}, recoverable},
    C{"recover.confirm", "Discard the work", key(GLFW_KEY_D, kCtrlShift), kNone, DiscardAsked{}, asks_to_discard},
    C{"export.write", "Export the files", key(GLFW_KEY_ENTER, kCtrl), kNone, WriteExport{}, can_write, nullptr, why_no_write},
    C{"export.cancel", "Cancel the export", kNone, kNone, CancelExport{}, can_cancel},
    C{"export.folder", "Open the folder", kNone, kNone, ShowExportFolder{}, has_written},
    C{"import.take", "Place on the wheel", key(GLFW_KEY_ENTER, kCtrlShift), kNone, TakeImport{}, can_import},

    // In the panel of the goal; not in a menu.
    C{"goal.bowl", "Target: the sample bowl", kNone, kNone, UseSampleTarget{0}, always},
    C{"goal.vase", "Target: the sample vase", kNone, kNone, UseSampleTarget{1}, always},
    C{"goal.bottle", "Target: the sample bottle", kNone, kNone, UseSampleTarget{2}, always},
    C{"goal.cylinder", "Target: the sample cylinder", kNone, kNone, UseSampleTarget{3}, always},
    C{"goal.file", "Target from a file...", kNone, kNone, ChooseTarget{}, always},
    C{"goal.none", "No target", kNone, kNone, ClearTarget{}, has_target},

    C{"tool.press", "Press", key(GLFW_KEY_P), kNone, SetToolMode{ToolMode::press}, always, is_mode<ToolMode::press>},
    C{"tool.trim", "Trim", key(GLFW_KEY_T), kNone, SetToolMode{ToolMode::trim}, always, is_mode<ToolMode::trim>},
    C{"tool.pinch", "Pinch", key(GLFW_KEY_H), kNone, SetToolMode{ToolMode::pinch}, always, is_mode<ToolMode::pinch>},
    C{"tool.smooth", "Smooth", key(GLFW_KEY_M), kNone, SetToolMode{ToolMode::smooth}, has_rules, is_mode<ToolMode::smooth>, why_no_rules},
    C{"tool.needle", "Needle: level the rim", key(GLFW_KEY_L), kNone, SetToolMode{ToolMode::needle}, always, is_mode<ToolMode::needle>},
    C{"tool.wire", "Wire: cut off the wheel", key(GLFW_KEY_K), kNone, SetToolMode{ToolMode::wire}, always, is_mode<ToolMode::wire>},
    C{"tool.trim_foot", "Foot: trim upside down", key(GLFW_KEY_U), kNone, SetToolMode{ToolMode::trim_foot}, always, is_mode<ToolMode::trim_foot>},
    C{"tool.next", "Next tool", kNone, kNone, StepTool{1}, always},
    C{"tool.previous", "Previous tool", kNone, kNone, StepTool{-1}, always},
    C{"tool.sphere", "Sphere", key(GLFW_KEY_S), kNone, SetToolShape{Shape::sphere}, always, is_shape<Shape::sphere>},
    C{"tool.ellipse", "Ellipse", key(GLFW_KEY_E), kNone, SetToolShape{Shape::ellipse}, always, is_shape<Shape::ellipse>},
    C{"tool.rib", "Rib", key(GLFW_KEY_R), kNone, SetToolShape{Shape::rib}, always, is_shape<Shape::rib>},
    C{"tool.smaller", "Smaller", key(GLFW_KEY_LEFT_BRACKET), kNone, ScaleTool{1.0 / kSizeStep}, always},
    C{"tool.larger", "Larger", key(GLFW_KEY_RIGHT_BRACKET), kNone, ScaleTool{kSizeStep}, always},
    C{"tool.size", "Set size with the mouse", key(GLFW_KEY_F), kNone, DragToolSize{}, can_drag, nullptr, why_no_drag},
    C{"tool.strength", "Set stiffness with the mouse", key(GLFW_KEY_F, kShift), kNone, DragStiffness{}, can_drag, nullptr, why_no_drag},
    C{"tool.narrower", "Narrower gap", key(GLFW_KEY_COMMA), kNone, ChangeGap{-kGapStepMm}, pinching},
    C{"tool.wider", "Wider gap", key(GLFW_KEY_PERIOD), kNone, ChangeGap{kGapStepMm}, pinching},

    C{"wheel.pause", "Pause", key(GLFW_KEY_SPACE), kNone, TogglePause{}, has_work, paused},
    C{"wheel.rearm", "Re-arm the force", key(GLFW_KEY_R, kShift), kNone, Rearm{}, rearmable},
    C{"wheel.zero_force", "Zero force, or go back", key(GLFW_KEY_ESCAPE), kNone, Back{}, always},

    C{"view.home", "Whole pot", key(GLFW_KEY_HOME), kNone, LookFrom{ViewFrom::home}, can_look, nullptr, why_no_look},
    C{"view.front", "Front", key(GLFW_KEY_1), key(GLFW_KEY_KP_1), LookFrom{ViewFrom::front}, can_look, nullptr, why_no_look},
    C{"view.right", "Right side", key(GLFW_KEY_3), key(GLFW_KEY_KP_3), LookFrom{ViewFrom::right}, can_look, nullptr, why_no_look},
    C{"view.top", "Top", key(GLFW_KEY_7), key(GLFW_KEY_KP_7), LookFrom{ViewFrom::top}, can_look, nullptr, why_no_look},
    C{"view.nearer", "Nearer", key(GLFW_KEY_PAGE_UP), kNone, Zoom{1.0}, can_look, nullptr, why_no_look},
    C{"view.farther", "Farther", key(GLFW_KEY_PAGE_DOWN), kNone, Zoom{-1.0}, can_look, nullptr, why_no_look},
    C{"view.cut_half", "Cut away half", key(GLFW_KEY_C), kNone, ToggleCut{render::Cut::half}, has_work, is_cut<render::Cut::half>, why_no_work},
    C{"view.cut_quarter", "Cut away a quarter", key(GLFW_KEY_C, kShift), kNone, ToggleCut{render::Cut::quarter}, has_work, is_cut<render::Cut::quarter>},
    C{"view.wall_map", "Wall thickness map", key(GLFW_KEY_W), kNone, ToggleWallMap{}, always, has_wall_map},
    C{"view.throwing_lines", "Throwing lines", kNone, kNone, ToggleThrowingLines{}, always, has_throwing_lines},
    C{"view.goal", "Goal", key(GLFW_KEY_O), kNone, TogglePanel{kGoal}, can_unfold, is_open<kGoal>, why_not_unfold},
    C{"view.section", "Section", key(GLFW_KEY_X), kNone, TogglePanel{kSection}, can_unfold, is_open<kSection>, why_not_unfold},
    C{"view.walls", "Walls", kNone, kNone, TogglePanel{kWalls}, can_unfold, is_open<kWalls>, why_not_unfold},
    C{"view.certificate", "Certificate", kNone, kNone, TogglePanel{kCertificate}, view_is_free, is_open<kCertificate>, why_view_is_held},
    C{"view.ledger", "Clay balance", kNone, kNone, TogglePanel{kLedger}, view_is_free, is_open<kLedger>, why_view_is_held},
    C{"view.stress", "Stress", kNone, kNone, TogglePanel{kStress}, view_is_free, is_open<kStress>, why_view_is_held},
    C{"view.servo", "Timing", kNone, kNone, TogglePanel{kServo}, view_is_free, is_open<kServo>, why_view_is_held},
    C{"view.diagnostics", "Diagnostics", key(GLFW_KEY_D), kNone, ToggleDiagnostics{}, view_is_free, has_diagnostics, why_view_is_held},
    C{"view.theme", "Light theme", key(GLFW_KEY_L, kCtrl), kNone, ToggleTheme{}, always, is_light},
    C{"view.mm", "Millimetres", kNone, kNone, SetUnit{LengthUnit::mm}, always, is_unit<LengthUnit::mm>},
    C{"view.cm", "Centimetres", kNone, kNone, SetUnit{LengthUnit::cm}, always, is_unit<LengthUnit::cm>},
    C{"view.in", "Inches", kNone, kNone, SetUnit{LengthUnit::in}, always, is_unit<LengthUnit::in>},
    C{"view.larger", "Larger text", key(GLFW_KEY_EQUAL, kCtrl), key(GLFW_KEY_EQUAL, kCtrlShift), ScaleText{kTextStep}, view_is_free, nullptr, why_view_is_held},
    C{"view.smaller", "Smaller text", key(GLFW_KEY_MINUS, kCtrl), kNone, ScaleText{1.0f / kTextStep}, view_is_free, nullptr, why_view_is_held},

    C{"help.show_step", "Show this step", key(GLFW_KEY_G), kNone, ShowStep{}, can_show_step, nullptr, why_no_show},
    C{"help.next_step", "Next step", key(GLFW_KEY_N), kNone, NextStep{}, in_step},
    C{"help.end_lesson", "End the lesson", kNone, kNone, EndLesson{}, in_lesson},
    C{"help.panels", "Go to the panels", key(GLFW_KEY_F6), kNone, NextColumn{}, can_go_to_panels, has_keys_in_panels, why_view_is_held},
    C{"help.menu", "Open the menu", key(GLFW_KEY_F10), kNone, OpenMenu{}, always},
    C{"help.hint", "First steps", kNone, kNone, ToggleHints{}, always, has_hints},
    C{"help.keys", "Controls", key(GLFW_KEY_SLASH, kShift), key(GLFW_KEY_F1), ShowDialog{Kind::shortcuts}, always},
};
// clang-format on

constexpr std::array kMenus = {Menu{"file.", "File"}, Menu{"edit.", "Edit"},
                               Menu{"tool.", "Tool"}, Menu{"wheel.", "Wheel"},
                               Menu{"view.", "View"}, Menu{"help.", "Help"}};

}  // namespace

std::span<const Command> commands() { return kCommands; }
std::span<const Menu> menus() { return kMenus; }

std::string tip_of(const Command& command, const ViewModel& model) {
  std::string tip = command.title;
  if (command.chord.key != 0) tip += fmt::format(" ({})", text_of(command.chord));
  const char* why = command.why_not != nullptr ? command.why_not(model) : nullptr;
  return why != nullptr ? fmt::format("{}: {}", tip, why) : tip;
}

const Command* find_command(std::string_view id) {
  const auto* found = std::ranges::find(kCommands, id, &Command::id);
  return found == kCommands.end() ? nullptr : found;
}

const Command* command_for(const KeyChord& chord) {
  if (chord.key == 0) return nullptr;
  const auto* found = std::ranges::find_if(kCommands, [&](const Command& command) {
    return command.chord == chord || command.second_chord == chord;
  });
  return found == kCommands.end() ? nullptr : found;
}

bool run(const Command& command, AppState& state) {
  if (!command.enabled(view_model(state))) return false;
  std::string line = "action: ";
  state.log(line.append(command.id));
  apply(state, command.action);
  return true;
}

}  // namespace clay::studio
