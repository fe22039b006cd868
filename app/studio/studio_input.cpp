// What comes from outside, one after the other.

#include "app/studio/actions.hpp"
#include "app/studio/studio.hpp"

#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>
#include <imgui.h>

namespace clay::studio {

/// A button or key changes at most once in a frame, and a button only where the pointer has been
/// for a frame: ImGui sees every click, however short.
void Studio::take_waiting() {
  bool moved = false, pressed = false;
  while (!waiting_.empty()) {
    const Input& next = waiting_.front();
    const bool is_move = std::holds_alternative<PointerMoved>(next);
    const bool is_press =
        std::holds_alternative<ButtonChanged>(next) || std::holds_alternative<KeyChanged>(next);
    if ((is_press && (pressed || moved)) || (is_move && pressed)) return;
    moved = moved || is_move;
    pressed = pressed || is_press;
    apply(next);
    waiting_.pop_front();
    awake_frames_ = kFramesAfterInput;
  }
}

void Studio::apply(const Input& input) {
  ImGuiIO& io = ImGui::GetIO();
  // What lies over the view has the mouse for itself.
  const bool view = shop_.overlay == Overlay::none && !io.WantCaptureMouse;
  if (const auto* moved = std::get_if<PointerMoved>(&input)) {
    io.MousePos = {moved->place_px.x, moved->place_px.y};
    shop_.view.pointer_moved(shop_, moved->place_px);
  } else if (const auto* change = std::get_if<ButtonChanged>(&input)) {
    const bool taken = (view || !change->down) && shop_.view.button(shop_, *change);
    if (!taken || !change->down) io.MouseDown[static_cast<int>(change->button)] = change->down;
    io.KeyCtrl = (change->mods & kControl) != 0;
    io.KeyShift = (change->mods & kShift) != 0;
  } else if (const auto* scrolled = std::get_if<Scrolled>(&input)) {
    if (!view || !shop_.view.scrolled(scrolled->steps)) io.MouseWheel += scrolled->steps;
  } else if (const auto* pressed = std::get_if<KeyChanged>(&input)) {
    key(*pressed);
  } else if (const auto* typed = std::get_if<TextTyped>(&input)) {
    io.AddInputCharacter(typed->character);
  } else if (const auto* files = std::get_if<FilesDropped>(&input)) {
    drop(*files);
  } else if (std::holds_alternative<CloseAsked>(input)) {
    run(*find_action("file.quit"), shop_);
  }
}

void Studio::key(const KeyChanged& change) {
  ImGuiIO& io = ImGui::GetIO();
  if (change.key >= 0 && change.key < 512) io.KeysDown[change.key] = change.down;
  io.KeyCtrl = (change.mods & kControl) != 0;
  io.KeyShift = (change.mods & kShift) != 0;
  io.KeyAlt = (change.mods & kAlt) != 0;
  if (!change.down) return;
  const Action* action = action_of({change.key, change.mods});
  if (action == nullptr) return;
  // In a box for text only what no text has in it is a shortcut.
  const bool edits = io.WantTextInput;
  if (edits && change.key != GLFW_KEY_ESCAPE &&
      ((change.mods & kControl) == 0 || change.key == GLFW_KEY_Z || change.key == GLFW_KEY_Y))
    return;
  if (change.repeated && !action->id.starts_with("tool.") && !action->id.starts_with("edit."))
    return;
  // Behind what is open over the view nothing changes.
  if (shop_.overlay != Overlay::none && change.key != GLFW_KEY_ESCAPE &&
      !action->id.starts_with("file.") && !action->id.starts_with("view.") &&
      !action->id.starts_with("help.") && !action->id.starts_with("quit.") &&
      !action->id.starts_with("export.") && !action->id.starts_with("recover.") &&
      !action->id.starts_with("import."))
    return;
  run(*action, shop_);
}

void Studio::drop(const FilesDropped& files) {
  if (!files.paths.empty()) open_file(shop_, files.paths.front());
}

}  // namespace clay::studio
