// Sends each input event of the window to ImGui, to the view, or to a command.

#include "app/studio/commands.hpp"
#include "app/studio/studio.hpp"

#define GLFW_INCLUDE_NONE
#include <fmt/format.h>
#include <imgui.h>

#include <GLFW/glfw3.h>

#include <algorithm>
#include <array>
#include <string>
#include <utility>

namespace clay::studio {
namespace {

/// Key codes are those of GLFW.
void map_keys(ImGuiIO& io) {
  constexpr std::array kKeys = {std::pair{ImGuiKey_Tab, GLFW_KEY_TAB},
                                std::pair{ImGuiKey_LeftArrow, GLFW_KEY_LEFT},
                                std::pair{ImGuiKey_RightArrow, GLFW_KEY_RIGHT},
                                std::pair{ImGuiKey_UpArrow, GLFW_KEY_UP},
                                std::pair{ImGuiKey_DownArrow, GLFW_KEY_DOWN},
                                std::pair{ImGuiKey_Home, GLFW_KEY_HOME},
                                std::pair{ImGuiKey_End, GLFW_KEY_END},
                                std::pair{ImGuiKey_Delete, GLFW_KEY_DELETE},
                                std::pair{ImGuiKey_Backspace, GLFW_KEY_BACKSPACE},
                                std::pair{ImGuiKey_Enter, GLFW_KEY_ENTER},
                                std::pair{ImGuiKey_Escape, GLFW_KEY_ESCAPE},
                                std::pair{ImGuiKey_A, GLFW_KEY_A},
                                std::pair{ImGuiKey_C, GLFW_KEY_C},
                                std::pair{ImGuiKey_V, GLFW_KEY_V},
                                std::pair{ImGuiKey_X, GLFW_KEY_X},
                                std::pair{ImGuiKey_Y, GLFW_KEY_Y},
                                std::pair{ImGuiKey_Z, GLFW_KEY_Z}};
  for (const auto& [ours, theirs] : kKeys) io.KeyMap[ours] = theirs;
}

void connect_clipboard(ImGuiIO& io, Host& host) {
  io.ClipboardUserData = &host;
  io.SetClipboardTextFn = [](void* user, const char* text) {
    static_cast<Host*>(user)->set_clipboard(text);
  };
  io.GetClipboardTextFn = [](void* user) -> const char* {
    static std::string held;  // kept until ImGui has copied it
    held = static_cast<Host*>(user)->clipboard();
    return held.c_str();
  };
}

/// A menu or a list is open.
bool menu_open() {
  return ImGui::GetFrameCount() > 0 &&
         ImGui::IsPopupOpen("", ImGuiPopupFlags_AnyPopupId | ImGuiPopupFlags_AnyPopupLevel);
}

/// In a dialog, and in the panels, these keys are for fields and buttons, and run no command.
bool for_fields(const KeyChanged& change) {
  const bool function_key = change.key >= GLFW_KEY_F1 && change.key <= GLFW_KEY_F25;
  return (change.mods & kControl) == 0 && change.key != GLFW_KEY_ENTER && !function_key;
}

/// Commands that are enabled while a dialog is open.
bool in_dialogs(const Command& command) {
  constexpr std::array kPrefixes = {"file.",   "view.",    "help.",   "quit.",
                                    "export.", "recover.", "import.", "replace."};
  return std::ranges::any_of(kPrefixes,
                             [&](const char* prefix) { return command.id.starts_with(prefix); });
}

}  // namespace

void connect_imgui(Host& host) {
  ImGuiIO& io = ImGui::GetIO();
  io.IniFilename = nullptr;
  io.LogFilename = nullptr;
  map_keys(io);
  connect_clipboard(io, host);
}

/// A button or key changes at most once per frame, and a button only after the pointer has been at
/// its place for a frame, so that ImGui registers every click, even a short one.
void Studio::handle_input() {
  bool moved = false, pressed = false;
  while (!input_.empty()) {
    const Input& next = input_.front();
    const bool is_move = std::holds_alternative<PointerMoved>(next);
    const bool is_press = std::holds_alternative<ButtonChanged>(next) ||
                          std::holds_alternative<KeyChanged>(next) ||
                          std::holds_alternative<GamepadChanged>(next);
    if ((is_press && (pressed || moved)) || (is_move && pressed)) return;
    moved = moved || is_move;
    pressed = pressed || is_press;
    apply(next);
    input_.pop_front();
    awake_frames_ = kFramesAfterInput;
  }
}

void Studio::apply(const Input& input) {
  ImGuiIO& io = ImGui::GetIO();
  const ViewModel model = view_model(state_);
  Actions actions;
  // A dialog captures the mouse.
  const bool view = state_.ui.shows<NoDialog>() && !io.WantCaptureMouse;
  if (const auto* moved = std::get_if<PointerMoved>(&input)) {
    io.MousePos = {moved->place_px.x, moved->place_px.y};
    state_.scene.pointer_moved(model, *moved, actions);
  } else if (const auto* change = std::get_if<ButtonChanged>(&input)) {
    // A press in the view ends a demonstration.
    if (view && change->down && change->button == MouseButton::left)
      actions.emplace_back(StopShowing{});
    if (view && change->down) state_.ui.keys_in.reset();
    const bool taken = (view || !change->down) && state_.scene.button(model, *change, actions);
    if (!taken || !change->down) io.MouseDown[static_cast<int>(change->button)] = change->down;
    io.KeyCtrl = (change->mods & kControl) != 0;
    io.KeyShift = (change->mods & kShift) != 0;
  } else if (const auto* scrolled = std::get_if<Scrolled>(&input)) {
    if (!view || !state_.scene.scrolled(model, scrolled->steps)) io.MouseWheel += scrolled->steps;
  } else if (const auto* pressed = std::get_if<KeyChanged>(&input)) {
    key(*pressed);
  } else if (const auto* typed = std::get_if<TextTyped>(&input)) {
    io.AddInputCharacter(typed->character);
  } else if (const auto* files = std::get_if<FilesDropped>(&input)) {
    if (files->paths.size() == 1)
      actions.emplace_back(OpenFile{files->paths.front()});
    else if (!files->paths.empty())
      report(state_, Error{ErrorKind::bad_input,
                           fmt::format("expected one file, found {}: drop one file at a time",
                                       files->paths.size())});
  } else if (std::holds_alternative<CloseAsked>(input)) {
    actions.emplace_back(RunCommand{"file.quit"});
  } else if (const auto* plugged = std::get_if<GamepadPlugged>(&input)) {
    plug_gamepad(plugged->name);
  } else if (const auto* pad = std::get_if<GamepadChanged>(&input)) {
    gamepad(pad->state);
  }
  apply_all(state_, actions);
}

void Studio::plug_gamepad(const std::string& name) {
  constexpr double kNoteS = 6.0;
  gamepad({});  // releases all
  const std::string lost = state_.gamepad.name();
  state_.gamepad.plug(name);
  state_.log(name.empty() ? "gamepad disconnected" : "gamepad: " + name);
  if (name.empty())
    note(state_, Grade::note, lost + " is disconnected", kNoteS);
  else
    note(state_, Grade::note, name + " is connected: F1 lists its buttons", kNoteS);
}

void Studio::gamepad(const GamepadState& pad) {
  const unsigned changed = state_.gamepad.pad().buttons ^ pad.buttons;
  state_.gamepad.take(pad);
  for (const PadBinding& binding : pad_bindings())
    if ((changed & bit_of(binding.button)) != 0)
      pad_button(binding, (pad.buttons & bit_of(binding.button)) != 0);
}

/// In menus and dialogs a button is a key, otherwise a command.
void Studio::pad_button(const PadBinding& binding, bool down) {
  int& held = pad_keys_[static_cast<std::size_t>(binding.button)];
  if (!down) {
    if (held != 0) key({std::exchange(held, 0), false, false, kNoMods});
    return;
  }
  if (!menu_open() && state_.ui.shows<NoDialog>()) {
    (void)run(*find_command(binding.command), state_);
    return;
  }
  held = binding.key == GLFW_KEY_SPACE ? key_that_chooses() : binding.key;
  if (held != 0) key({held, true, false, kNoMods});
}

/// In dialogs that are lists.
bool Studio::enter_chooses() const {
  return state_.ui.shows<GalleryDialog>() || state_.ui.shows<WorksDialog>();
}

/// In menus and lists Enter chooses, and in a text field it accepts the text.
int Studio::key_that_chooses() const {
  const bool enter = menu_open() || enter_chooses() || state_.ui.shows<OpenDialog>() ||
                     state_.ui.shows<SaveDialog>();
  return enter ? GLFW_KEY_ENTER : GLFW_KEY_SPACE;
}

/// Arrows, Enter and Space move and choose in menus, dialogs and, after F6, panels, and have no
/// other effect there. Over the clay these keys run commands. In a dialog Enter is the key of its
/// default button.
void Studio::let_keys_navigate() {
  ImGuiIO& io = ImGui::GetIO();
  const bool menu = menu_open();
  // In a dialog with one text field, the field has the keyboard focus from the start.
  const bool typing = state_.ui.shows<OpenDialog>() || state_.ui.shows<SaveDialog>();
  if (menu || (state_.ui.shows<NoDialog>() ? state_.ui.keys_in.has_value() : !typing))
    io.ConfigFlags |= ImGuiConfigFlags_NavEnableKeyboard;
  else
    io.ConfigFlags &= ~ImGuiConfigFlags_NavEnableKeyboard;
  io.KeyMap[ImGuiKey_Space] = menu || enter_chooses() ? GLFW_KEY_ENTER : GLFW_KEY_SPACE;
}

void Studio::key(const KeyChanged& change) {
  ImGuiIO& io = ImGui::GetIO();
  if (change.key >= 0 && change.key < 512) io.KeysDown[change.key] = change.down;
  io.KeyCtrl = (change.mods & kControl) != 0;
  io.KeyShift = (change.mods & kShift) != 0;
  io.KeyAlt = (change.mods & kAlt) != 0;
  if (!change.down) return;
  // An open menu is topmost: Esc closes it, and keys without Ctrl are for it. Where an arm is in
  // use, Esc also sets the force to zero.
  if (menu_open() && (change.mods & kControl) == 0 &&
      !(change.key == GLFW_KEY_ESCAPE && state_.stroke.has_device()))
    return;
  const Command* command = command_for({change.key, change.mods});
  if (command == nullptr) return;
  // A text field captures the keys that edit text.
  const bool edits_text =
      (change.mods & kControl) == 0 || change.key == GLFW_KEY_Z || change.key == GLFW_KEY_Y;
  if (change.key != GLFW_KEY_ESCAPE) {
    if (io.WantTextInput && edits_text) return;
    const bool dialog = !state_.ui.shows<NoDialog>();
    if ((dialog || state_.ui.keys_in) && for_fields(change)) return;
    if (dialog && !in_dialogs(*command)) return;
  }
  if (change.repeated && !command->id.starts_with("tool.") && !command->id.starts_with("edit."))
    return;
  (void)run(*command, state_);
}

}  // namespace clay::studio
