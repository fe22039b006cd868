#pragma once
// Controls and texts of the window, for screen readers: the page has them as hidden elements in its
// canvas (page/controls.js).

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace clay::web {

/// A text or control of the window.
struct WindowItem {
  /// `part` and `dialog` begin a group, which extends to the next of them.
  enum class Role { part, dialog, text, button, checkbox, slider, field, choice, header };
  Role role = Role::text;
  std::uint32_t id = 0;     ///< ImGui's; 0: not a control
  std::string name, value;  ///< empty: none
  bool disabled = false;
  std::optional<bool> on;  ///< checked, chosen or unfolded; absent: it has no such state
};

/// Reads one frame of ImGui, in the order in which it is drawn. Requires an ImGui with the hooks of
/// its test engine (IMGUI_ENABLE_TEST_ENGINE), as that in cmake/web.
class WindowReader {
 public:
  /// Before the frame.
  void begin();
  /// After the frame. Returns {"focus": ID, "items": [{"role", "id", "name", "value", "disabled",
  /// "on"}, ...]} as JSON. Absent and empty members are omitted; `focus` is the control that has
  /// the keyboard, or 0.
  [[nodiscard]] std::string end();

  // ImGui calls these while it draws.
  void item_begins(std::uint32_t id);
  void item_ends(std::uint32_t id, std::string_view label, int flags);
  void log_ends(std::string_view rest);

 private:
  void take_log();
  void take_text(std::string_view text);
  void add_text(std::string_view text);
  void enter_window();
  void close_item();
  WindowItem& control_at(std::uint32_t id);
  void name_from_text(WindowItem& item, std::string_view hidden);
  void value_from_text(WindowItem& item);

  std::vector<WindowItem> items_;
  std::size_t last_ = 0;       // index + 1 of the last control; 0: none
  std::uint32_t open_id_ = 0;  // between the two calls for an item
  std::string open_text_;      // text that was drawn since the first of them
  const void* window_ = nullptr;
  bool ignored_ = false;  // the present window
  int frame_ = -1;
};

}  // namespace clay::web
