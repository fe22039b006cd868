#include "app/web/window_reader.hpp"

#include <imgui_internal.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <array>
#include <utility>

namespace clay::web {
namespace {

using Role = WindowItem::Role;

WindowReader* reading = nullptr;  // while a frame is read
void (*copy_text)(void* user, const char* text) = nullptr;

struct Part {
  std::string_view window, name;
};
constexpr std::array kParts = {
    Part{"##MainMenuBar", "Menu"}, Part{"##strip", "Tools and views"},
    Part{"##context", "Panels"},   Part{"##diagnostics", "Diagnostics"},
    Part{"##status", "Status"},    Part{"##timeline", "Strokes"},
    Part{"##guide", "Lesson"},     Part{"##hint", "First steps"},
    Part{"##state", "Message"},    Part{"##answer", "Message"},
};

/// ImGui shows a label up to these characters; the rest distinguishes controls.
std::string_view shown_part(std::string_view label) { return label.substr(0, label.find("##")); }
std::string_view hidden_part(std::string_view label) {
  const std::size_t from = label.find("##");
  return from == label.npos ? std::string_view() : label.substr(label.find_first_not_of('#', from));
}

std::string_view trimmed(std::string_view text) {
  const std::size_t from = text.find_first_not_of(" \n\r");
  if (from == text.npos) return {};
  return text.substr(from, text.find_last_not_of(" \n\r") + 1 - from);
}

/// ImGui's log has values in braces: "{ 5 mm }". Empty: none.
std::string_view value_in(std::string_view text) {
  const std::size_t from = text.find('{'), to = text.rfind('}');
  if (from == text.npos || to == text.npos || to < from) return {};
  return trimmed(text.substr(from + 1, to - from - 1));
}

/// In the order of the roles.
constexpr std::array kRoleNames = {"part",   "dialog", "text",   "button", "checkbox",
                                   "slider", "field",  "choice", "header"};
static_assert(kRoleNames.size() == static_cast<std::size_t>(Role::header) + 1);

nlohmann::json json_of(const WindowItem& item) {
  nlohmann::json json{{"role", kRoleNames[static_cast<std::size_t>(item.role)]},
                      {"name", item.name}};
  if (item.id != 0) json["id"] = item.id;
  if (!item.value.empty()) json["value"] = item.value;
  if (item.disabled) json["disabled"] = true;
  if (item.on) json["on"] = *item.on;
  return json;
}

}  // namespace

void WindowReader::begin() {
  ImGuiContext& g = *ImGui::GetCurrentContext();
  reading = this;
  items_.clear();
  frame_ = -1;
  g.TestEngineHookItems = true;
  // ImGui copies its log to the clipboard at the end of each window.
  copy_text = std::exchange(g.IO.SetClipboardTextFn, [](void* user, const char* text) {
    const ImGuiContext& context = *ImGui::GetCurrentContext();
    if (context.LogEnabled && text == context.LogBuffer.begin())
      reading->log_ends(text);
    else if (copy_text != nullptr)
      copy_text(user, text);
  });
}

std::string WindowReader::end() {
  ImGuiContext& g = *ImGui::GetCurrentContext();
  close_item();
  g.TestEngineHookItems = false;
  g.IO.SetClipboardTextFn = copy_text;
  reading = nullptr;
  nlohmann::json items = nlohmann::json::array();
  // Beside a dialog nothing else takes keys or clicks, except a message.
  const bool dialog = std::ranges::find(items_, Role::dialog, &WindowItem::role) != items_.end();
  bool left_out = false;
  for (const WindowItem& item : items_) {
    if (item.role == Role::part) left_out = dialog && item.name != "Message";
    if (item.role == Role::dialog) left_out = false;
    if (!left_out && !item.name.empty()) items.push_back(json_of(item));
  }
  const bool typing = g.ActiveId != 0 && g.ActiveId == g.InputTextState.ID;
  const bool by_keys = !g.NavDisableHighlight || g.OpenPopupStack.Size > 0;
  const ImGuiID focus = typing ? g.ActiveId : by_keys ? g.NavId : 0;
  return nlohmann::json{{"focus", focus}, {"items", std::move(items)}}.dump(
      -1, ' ', false, nlohmann::json::error_handler_t::replace);
}

void WindowReader::item_begins(std::uint32_t id) {
  take_log();
  close_item();
  enter_window();
  open_id_ = id;
}

/// A combo box has no second call. What other items draw without one is text.
void WindowReader::close_item() {
  const std::uint32_t id = std::exchange(open_id_, 0);
  const std::string text = std::exchange(open_text_, {});
  const std::string_view drawn = trimmed(text);
  if (id == 0 || !drawn.starts_with('{')) return add_text(drawn);
  const std::size_t end = std::min(drawn.find('}'), drawn.size() - 1) + 1;
  WindowItem& item = control_at(id);
  item.role = Role::choice;
  item.value = value_in(drawn.substr(0, end));
  name_from_text(item, "");
  add_text(drawn.substr(end));
}

void WindowReader::item_ends(std::uint32_t id, std::string_view label, int flags) {
  take_log();
  ImGuiContext& g = *ImGui::GetCurrentContext();
  if (open_id_ != id) close_item();
  open_id_ = 0;
  const std::string drawn = std::exchange(open_text_, {});
  // ImGui keeps a brace of an empty value for the next text.
  const char* left = std::exchange(g.LogNextPrefix, nullptr);
  g.LogNextSuffix = nullptr;
  const bool valued = drawn.find('{') != drawn.npos || (left != nullptr && *left == '{');
  WindowItem& item = control_at(id);
  item.disabled = (g.LastItemData.InFlags & ImGuiItemFlags_Disabled) != 0;
  item.name = trimmed(shown_part(label));
  // The texts of a menu's line: its name, and its keys.
  if (item.value.starts_with(item.name))
    item.value = std::string(trimmed(std::string_view(item.value).substr(item.name.size())));
  constexpr int kMarked = ImGuiItemStatusFlags_Checkable | ImGuiItemStatusFlags_Openable;
  const bool in_menu = (g.CurrentWindow->Flags & ImGuiWindowFlags_ChildMenu) != 0;
  if ((flags & kMarked) == kMarked || (!in_menu && (flags & ImGuiItemStatusFlags_Checkable) != 0)) {
    item.on = (flags & ImGuiItemStatusFlags_Checked) != 0;
    item.role = Role::checkbox;
  } else if ((flags & ImGuiItemStatusFlags_Openable) != 0) {
    item.on = (flags & ImGuiItemStatusFlags_Opened) != 0;
    item.role = valued ? Role::choice : Role::header;
    item.value = value_in(drawn);
  } else if (valued) {
    item.role =
        (g.LastItemData.InFlags & ImGuiItemFlags_Inputable) != 0 ? Role::field : Role::slider;
    item.value = value_in(drawn);
  }
  if (item.name.empty()) name_from_text(item, hidden_part(label));
  if (item.role == Role::slider && item.value.empty()) value_from_text(item);
}

void WindowReader::log_ends(std::string_view rest) {
  take_text(rest);
  close_item();
}

/// Starts the log in a window that did not.
void WindowReader::take_log() {
  ImGuiContext& g = *ImGui::GetCurrentContext();
  if (g.FrameCount != frame_) {
    frame_ = g.FrameCount;
    items_.clear();
    last_ = 0;
    open_id_ = 0;
    open_text_.clear();
    window_ = nullptr;
  }
  if (!g.LogEnabled) return ImGui::LogToClipboard(0);
  take_text(g.LogBuffer.c_str());
  g.LogBuffer.clear();
}

void WindowReader::take_text(std::string_view text) {
  enter_window();
  open_text_ += text;
}

/// Each line is a text, except one that continues a sentence. Rules are left out.
void WindowReader::add_text(std::string_view text) {
  bool follows = false;
  while (!text.empty()) {
    const std::size_t end = std::min(text.find('\n'), text.size());
    const std::string_view line = trimmed(text.substr(0, end));
    text.remove_prefix(std::min(end + 1, text.size()));
    if (line.find_first_not_of("- ") == line.npos || ignored_) continue;
    if (follows && line[0] >= 'a' && line[0] <= 'z')
      items_.back().name.append(1, ' ').append(line);
    else
      items_.emplace_back().name = line;
    follows = true;
  }
}

/// Begins a group if the present window is another one.
void WindowReader::enter_window() {
  const ImGuiWindow* window = ImGui::GetCurrentWindowRead()->RootWindow;
  // Menus and lists of a combo box follow their button.
  const ImGuiWindowFlags within = ImGuiWindowFlags_Popup | ImGuiWindowFlags_Tooltip;
  if (window == window_ || (window->Flags & within) != 0) return;
  close_item();
  window_ = window;
  const std::string_view name = window->Name;
  const auto* part = std::ranges::find(kParts, name, &Part::window);
  const bool dialog = part == kParts.end();
  ignored_ = dialog && !name.starts_with("##");  // the window that ImGui always has
  if (ignored_) return;
  WindowItem& group = items_.emplace_back();
  group.role = dialog ? Role::dialog : Role::part;
  group.name = dialog ? hidden_part(name) : part->name;
}

/// A new control, or the last one: ImGui calls twice for the parts of a menu, first without a name.
WindowItem& WindowReader::control_at(std::uint32_t id) {
  const bool menu =
      last_ > 0 && items_[last_ - 1].role == Role::button && items_[last_ - 1].name.empty();
  if (menu || (last_ > 0 && items_[last_ - 1].id == id)) {
    WindowItem& last = items_[last_ - 1];
    for (std::size_t i = last_; i < items_.size(); ++i)
      if (items_[i].role == Role::text && items_[i].name != last.name) last.value = items_[i].name;
    items_.resize(last_);
    return last;
  }
  last_ = items_.size() + 1;
  WindowItem& item = items_.emplace_back();
  item.role = Role::button;
  item.id = id;
  return item;
}

/// The text before a control without a name is its name.
void WindowReader::name_from_text(WindowItem& item, std::string_view hidden) {
  item.name = hidden;
  const bool listed = item.role == Role::field || item.role == Role::choice;
  if (!listed || items_.size() < 2 || &item != &items_.back()) return;
  WindowItem& before = items_[items_.size() - 2];
  if (before.role == Role::text) {
    item.name = before.name;
    before.name.clear();
  }
}

/// The text before a slider is its name and value: "Radius 12 mm".
void WindowReader::value_from_text(WindowItem& item) {
  if (items_.size() < 2 || &item != &items_.back()) return;
  WindowItem& before = items_[items_.size() - 2];
  if (before.role != Role::text || !before.name.starts_with(item.name)) return;
  item.value = trimmed(std::string_view(before.name).substr(item.name.size()));
  before.name.clear();
}

}  // namespace clay::web

// The functions that ImGui expects of a test engine. Labels of deeper levels are not needed.
void ImGuiTestEngineHook_ItemAdd(ImGuiContext*, const ImRect&, ImGuiID id) {
  if (clay::web::reading != nullptr) clay::web::reading->item_begins(id);
}
void ImGuiTestEngineHook_ItemInfo(ImGuiContext*, ImGuiID id, const char* label,
                                  ImGuiItemStatusFlags flags) {
  if (clay::web::reading != nullptr) clay::web::reading->item_ends(id, label, flags);
}
void ImGuiTestEngineHook_Log(ImGuiContext*, const char*, ...) {}
const char* ImGuiTestEngine_FindItemDebugLabel(ImGuiContext*, ImGuiID) { return nullptr; }
