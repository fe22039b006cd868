// Actions on files and on the tree of strokes.

#include "app/studio/action_parts.hpp"
#include "app/studio/input.hpp"
#include "app/studio/samples.hpp"

#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>

#include <algorithm>
#include <array>

namespace clay::studio {
namespace {

constexpr unsigned kControlShift = kControl | kShift;
constexpr KeyChord kNone{};

/// An arm's stroke under way too: it is ended first.
bool can_undo(const AppState& shop) {
  const bool under_way = shop.potter.throwing() && shop.potter.status().poses > 0;
  return between(shop) && (shop.potter.can_undo() || under_way);
}
bool can_redo(const AppState& shop) { return between(shop) && shop.potter.can_redo(); }
bool asks(const AppState& shop) { return shop.overlay == Overlay::quit_prompt; }
bool exports(const AppState& shop) {
  const std::string& name = shop.exporting.wish.name;
  if (name.empty() || name.find('/') != std::string::npos) return false;
  return shop.overlay == Overlay::export_files &&
         shop.exporter.running() != Exporter::Kind::files && !paths_of(shop.exporting.wish).empty();
}
bool writes(const AppState& shop) { return shop.exporter.running() == Exporter::Kind::files; }
bool has_written(const AppState& shop) { return !shop.exporting.written.empty(); }
bool imports(const AppState& shop) {
  return shop.overlay == Overlay::import_drawing && shop.importing.made;
}

template <std::size_t index>
void new_sample(AppState& shop) {
  if (auto scene = scene_of(samples()[index])) begin_work(shop, *scene);
}

void save(AppState& shop) {
  if (shop.file.empty()) return ask_for_save(shop);
  save_to(shop, shop.file);
}

void quit(AppState& shop) {
  ask_first(shop, "quit", [](AppState& s) { s.done = true; });
}

/// The nearest stroke on the way back beside which there is another; nothing where there is none.
std::optional<history::NodeId> other_branch(const AppState& shop) {
  if (!between(shop)) return std::nullopt;
  const history::Work& work = shop.potter.work();
  for (history::NodeId node = work.at(); node != 0; node = work.view(node).parent) {
    const auto siblings = work.view(work.view(node).parent).children;
    if (siblings.size() < 2) continue;
    const auto here = std::ranges::find(siblings, node);
    return here + 1 == siblings.end() ? siblings.front() : *(here + 1);
  }
  return std::nullopt;
}

void export_folder(AppState& shop) {
  const auto folder = std::filesystem::path(shop.exporting.written.front()).parent_path();
  if (!show_folder(folder))
    shop.notices.say(Grade::warning, "No file manager is installed: the files are in " +
                                         (folder.empty() ? "this folder" : folder.string()));
}

using A = Action;
const std::array kFileActions = {
    A{"file.new",
      "New...",
      {GLFW_KEY_N, kControl},
      kNone,
      between,
      [](AppState& s) { s.overlay = Overlay::gallery; }},
    A{"file.new_bowl", "New bowl", kNone, kNone, always, new_sample<0>},
    A{"file.new_vase", "New vase", kNone, kNone, always, new_sample<1>},
    A{"file.new_bottle", "New bottle", kNone, kNone, always, new_sample<2>},
    A{"file.new_cylinder", "New cylinder", kNone, kNone, always, new_sample<3>},
    A{"file.open", "Open...", {GLFW_KEY_O, kControl}, kNone, always, ask_for_open},
    A{"file.save", "Save", {GLFW_KEY_S, kControl}, kNone, between, save},
    A{"file.save_as", "Save as...", {GLFW_KEY_S, kControlShift}, kNone, between, ask_for_save},
    A{"file.export", "Export...", {GLFW_KEY_E, kControl}, kNone, between, ask_for_export},
    A{"file.settings",
      "Settings...",
      {GLFW_KEY_COMMA, kControl},
      kNone,
      always,
      [](AppState& s) { s.overlay = Overlay::settings; }},
    A{"file.quit", "Quit", {GLFW_KEY_Q, kControl}, kNone, always, quit},
    A{"edit.undo",
      "Undo stroke",
      {GLFW_KEY_Z, kControl},
      kNone,
      can_undo,
      [](AppState& s) { s.potter.undo(); }},
    A{"edit.redo",
      "Redo stroke",
      {GLFW_KEY_Z, kControlShift},
      {GLFW_KEY_Y, kControl},
      can_redo,
      [](AppState& s) { s.potter.redo(); }},
    A{"edit.to_start",
      "Back to the start",
      {GLFW_KEY_HOME, kControl},
      kNone,
      can_undo,
      [](AppState& s) { s.potter.go_to(0); }},
    A{"edit.other_branch",
      "Other branch",
      {GLFW_KEY_B, kControl},
      kNone,
      [](const AppState& s) { return other_branch(s).has_value(); },
      [](AppState& s) { s.potter.go_to(*other_branch(s)); }},
    A{"edit.branch",
      "Go on from this moment",
      {GLFW_KEY_B, kControlShift},
      kNone,
      [](const AppState& s) { return s.potter.scrubbing(); },
      [](AppState& s) { s.potter.branch_here(); }},
    // Of cards; in no menu.
    A{"quit.save", "Save first", {GLFW_KEY_ENTER, 0}, kNone, asks, keep_it},
    A{"quit.discard", "Do not save", {GLFW_KEY_D, kControl}, kNone, asks, let_it_go},
    A{"quit.cancel", "Go on throwing", kNone, kNone, asks, close_overlay},
    A{"recover.take",
      "Recover the work that was left",
      {GLFW_KEY_R, kControl},
      kNone,
      [](const AppState& s) { return !s.left.empty(); },
      [](AppState& s) { recover_work(s, 0); }},
    A{"recover.discard", "Discard the work that was left", kNone, kNone,
      [](const AppState& s) { return !s.left.empty(); }, [](AppState& s) { discard_work(s, 0); }},
    A{"export.write", "Write the files", {GLFW_KEY_ENTER, kControl}, kNone, exports, write_export},
    A{"export.cancel", "Cancel the export", kNone, kNone, writes,
      [](AppState& s) { s.exporter.cancel(); }},
    A{"export.folder", "Open the folder", kNone, kNone, has_written, export_folder},
    A{"import.take",
      "Put it on the wheel",
      {GLFW_KEY_ENTER, kControlShift},
      kNone,
      imports,
      take_import},
};

}  // namespace

std::span<const Action> file_actions() { return kFileActions; }

}  // namespace clay::studio
