#include "studio/actions.hpp"

#include "studio/input.hpp"
#include "studio/samples.hpp"
#include "studio/workshop.hpp"

#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>

#include <algorithm>
#include <array>

namespace clay::studio {
namespace {

constexpr unsigned kControlShift = kControl | kShift;
constexpr double kSizeStep = 1.1;
constexpr float kScaleStep = 1.1f;

bool always(const Workshop&) { return true; }
bool has_work(const Workshop& shop) { return shop.potter.has_work(); }
bool at_rest(const Workshop& shop) { return has_work(shop) && !shop.potter.throwing(); }
/// An arm throws all the time: there the stroke that lasts is ended first.
bool between(const Workshop& shop) { return at_rest(shop) || shop.potter.has_device(); }
bool can_undo(const Workshop& shop) { return between(shop) && shop.potter.can_undo(); }
bool can_redo(const Workshop& shop) { return between(shop) && shop.potter.can_redo(); }
bool asks(const Workshop& shop) { return shop.overlay == Overlay::quit_prompt; }
bool pinching(const Workshop& shop) { return shop.settings.tool.mode == ToolMode::pinch; }

template <ToolMode mode>
void set_mode(Workshop& shop) {
  shop.settings.tool.mode = mode;
}
template <ToolMode mode>
bool is_mode(const Workshop& shop) {
  return shop.settings.tool.mode == mode;
}
template <Shape shape>
void set_shape(Workshop& shop) {
  shop.settings.tool.shape = shape;
}
template <Shape shape>
bool is_shape(const Workshop& shop) {
  return shop.settings.tool.shape == shape;
}
template <Seen from>
void look(Workshop& shop) {
  shop.view.look(shop, from);
}
template <draw::Cut cut>
void set_cut(Workshop& shop) {
  shop.view.cut = shop.view.cut == cut ? draw::Cut::none : cut;
}
template <draw::Cut cut>
bool is_cut(const Workshop& shop) {
  return shop.view.cut == cut;
}
template <LengthUnit unit>
void set_unit(Workshop& shop) {
  shop.settings.unit = unit;
}
template <LengthUnit unit>
bool is_unit(const Workshop& shop) {
  return shop.settings.unit == unit;
}
template <std::size_t index>
void new_sample(Workshop& shop) {
  if (auto scene = scene_of(samples()[index])) begin_work(shop, *scene);
}

void set_scale(Workshop& shop, float scale) {
  shop.settings.scale = std::clamp(scale, kSmallestScale, kLargestScale);
  shop.restyle = true;
}

void quit(Workshop& shop) {
  shop.potter.release();
  if (!shop.potter.has_work() || !shop.potter.unsaved()) {
    shop.done = true;
    return;
  }
  shop.overlay = Overlay::quit_prompt;
  shop.log("prompt: quit");
}

void save(Workshop& shop) {
  if (!shop.file.empty()) {
    save_to(shop, shop.file);
    return;
  }
  shop.path_box =
      (std::filesystem::path(shop.settings.folder) / (shop.potter.scene().name + ".work")).string();
  shop.overlay = Overlay::save_file;
}

void save_as(Workshop& shop) {
  const std::filesystem::path before = shop.file;
  shop.file.clear();
  save(shop);
  shop.file = before;
}

void open(Workshop& shop) {
  shop.path_box = shop.settings.folder;
  shop.overlay = Overlay::open_file;
}

void pause(Workshop& shop) {
  shop.paused = !shop.paused;
  shop.potter.command({live::CommandKind::pause, shop.paused ? 1.0 : 0.0});
}

/// Esc: out of what is open, else no force in this very moment.
void back(Workshop& shop) {
  if (shop.view.sizing()) return shop.view.cancel(shop);
  if (shop.overlay != Overlay::none) return close_overlay(shop);
  if (shop.potter.throwing() && !shop.potter.has_device()) return shop.potter.release();
  if (shop.potter.throwing()) return pause(shop);
  shop.notices.close();
}

constexpr std::array kMenus = {MenuTitle{"file.", "File"}, MenuTitle{"edit.", "Edit"},
                               MenuTitle{"tool.", "Tool"}, MenuTitle{"wheel.", "Wheel"},
                               MenuTitle{"view.", "View"}, MenuTitle{"help.", "Help"}};

constexpr KeyChord kNone{};

const std::
    array
        kActions =
            {
                Action{"file.new",
                       "New...",
                       {GLFW_KEY_N, kControl},
                       kNone,
                       between,
                       [](Workshop& s) { s.overlay = Overlay::gallery; }},
                Action{"file.new_bowl", "New bowl", kNone, kNone, always, new_sample<0>},
                Action{"file.new_vase", "New vase", kNone, kNone, always, new_sample<1>},
                Action{"file.new_bottle", "New bottle", kNone, kNone, always, new_sample<2>},
                Action{"file.new_cylinder", "New cylinder", kNone, kNone, always, new_sample<3>},
                Action{"file.open", "Open...", {GLFW_KEY_O, kControl}, kNone, always, open},
                Action{"file.save", "Save", {GLFW_KEY_S, kControl}, kNone, between, save},
                Action{"file.save_as",
                       "Save as...",
                       {GLFW_KEY_S, kControlShift},
                       kNone,
                       between,
                       save_as},
                Action{"file.quit", "Quit", {GLFW_KEY_Q, kControl}, kNone, always, quit},
                Action{"edit.undo",
                       "Undo stroke",
                       {GLFW_KEY_Z, kControl},
                       kNone,
                       can_undo,
                       [](Workshop& s) { s.potter.undo(); }},
                Action{"edit.redo",
                       "Redo stroke",
                       {GLFW_KEY_Z, kControlShift},
                       {GLFW_KEY_Y, kControl},
                       can_redo,
                       [](Workshop& s) { s.potter.redo(); }},
                Action{"tool.press",
                       "Press",
                       {GLFW_KEY_P, 0},
                       kNone,
                       always,
                       set_mode<ToolMode::press>,
                       is_mode<ToolMode::press>},
                Action{"tool.trim",
                       "Trim",
                       {GLFW_KEY_T, 0},
                       kNone,
                       always,
                       set_mode<ToolMode::trim>,
                       is_mode<ToolMode::trim>},
                Action{"tool.pinch",
                       "Pinch",
                       {GLFW_KEY_H, 0},
                       kNone,
                       always,
                       set_mode<ToolMode::pinch>,
                       is_mode<ToolMode::pinch>},
                Action{"tool.sphere",
                       "Sphere",
                       {GLFW_KEY_S, 0},
                       kNone,
                       always,
                       set_shape<Shape::sphere>,
                       is_shape<Shape::sphere>},
                Action{"tool.ellipse",
                       "Ellipse",
                       {GLFW_KEY_E, 0},
                       kNone,
                       always,
                       set_shape<Shape::ellipse>,
                       is_shape<Shape::ellipse>},
                Action{"tool.rib",
                       "Rib",
                       {GLFW_KEY_R, 0},
                       kNone,
                       always,
                       set_shape<Shape::rib>,
                       is_shape<Shape::rib>},
                Action{"tool.smaller",
                       "Smaller",
                       {GLFW_KEY_LEFT_BRACKET, 0},
                       kNone,
                       always,
                       [](Workshop& s) { resize(s.settings.tool, 1.0 / kSizeStep); }},
                Action{"tool.larger",
                       "Larger",
                       {GLFW_KEY_RIGHT_BRACKET, 0},
                       kNone,
                       always,
                       [](Workshop& s) { resize(s.settings.tool, kSizeStep); }},
                Action{"tool.size",
                       "Set size with the mouse",
                       {GLFW_KEY_F, 0},
                       kNone,
                       at_rest,
                       [](Workshop& s) { s.view.begin_sizing(s); }},
                Action{"tool.strength",
                       "Set stiffness with the mouse",
                       {GLFW_KEY_F, kShift},
                       kNone,
                       at_rest,
                       [](Workshop& s) { s.view.begin_strength(s); }},
                Action{"tool.narrower",
                       "Narrower gap",
                       {GLFW_KEY_COMMA, 0},
                       kNone,
                       pinching,
                       [](Workshop& s) {
                         s.settings.tool.gap_mm =
                             std::max(kNarrowestGapMm, s.settings.tool.gap_mm - 0.5);
                       }},
                Action{"tool.wider",
                       "Wider gap",
                       {GLFW_KEY_PERIOD, 0},
                       kNone,
                       pinching,
                       [](Workshop& s) {
                         s.settings.tool.gap_mm =
                             std::min(kWidestPinchMm, s.settings.tool.gap_mm + 0.5);
                       }},
                Action{"wheel.pause",
                       "Pause",
                       {GLFW_KEY_SPACE, 0},
                       kNone,
                       has_work,
                       pause,
                       [](const Workshop& s) { return s.paused; }},
                Action{"wheel.zero_force",
                       "Zero force, or back",
                       {GLFW_KEY_ESCAPE, 0},
                       kNone,
                       always,
                       back},
                Action{"view.home",
                       "Whole pot",
                       {GLFW_KEY_HOME, 0},
                       kNone,
                       has_work,
                       look<Seen::home>},
                Action{"view.front",
                       "From the front",
                       {GLFW_KEY_1, 0},
                       {GLFW_KEY_KP_1, 0},
                       has_work,
                       look<Seen::front>},
                Action{"view.right",
                       "From the right",
                       {GLFW_KEY_3, 0},
                       {GLFW_KEY_KP_3, 0},
                       has_work,
                       look<Seen::right>},
                Action{"view.top",
                       "From above",
                       {GLFW_KEY_7, 0},
                       {GLFW_KEY_KP_7, 0},
                       has_work,
                       look<Seen::top>},
                Action{"view.cut_half",
                       "Cut in half",
                       {GLFW_KEY_C, 0},
                       kNone,
                       has_work,
                       set_cut<draw::Cut::half>,
                       is_cut<draw::Cut::half>},
                Action{"view.cut_quarter",
                       "Cut a quarter",
                       {GLFW_KEY_C, kShift},
                       kNone,
                       has_work,
                       set_cut<draw::Cut::quarter>,
                       is_cut<draw::Cut::quarter>},
                Action{"view.theme",
                       "Light theme",
                       {GLFW_KEY_L, kControl},
                       kNone,
                       always,
                       [](Workshop& s) {
                         s.settings.theme =
                             s.settings.theme == Theme::dark ? Theme::light : Theme::dark;
                         s.restyle = true;
                       },
                       [](const Workshop& s) { return s.settings.theme == Theme::light; }},
                Action{"view.mm", "Millimetres", kNone, kNone, always, set_unit<LengthUnit::mm>,
                       is_unit<LengthUnit::mm>},
                Action{"view.cm", "Centimetres", kNone, kNone, always, set_unit<LengthUnit::cm>,
                       is_unit<LengthUnit::cm>},
                Action{"view.in", "Inches", kNone, kNone, always, set_unit<LengthUnit::in>,
                       is_unit<LengthUnit::in>},
                Action{"view.larger",
                       "Larger text",
                       {GLFW_KEY_EQUAL, kControl},
                       {GLFW_KEY_EQUAL, kControlShift},
                       always,
                       [](Workshop& s) { set_scale(s, s.settings.scale * kScaleStep); }},
                Action{"view.smaller",
                       "Smaller text",
                       {GLFW_KEY_MINUS, kControl},
                       kNone,
                       always,
                       [](Workshop& s) { set_scale(s, s.settings.scale / kScaleStep); }},
                Action{"help.keys",
                       "Keys and mouse",
                       {GLFW_KEY_SLASH, kShift},
                       {GLFW_KEY_F1, 0},
                       always,
                       [](Workshop& s) { s.overlay = Overlay::shortcuts; }},
                // Answers to the question before the window closes; in no menu.
                Action{"quit.save",
                       "Save and quit",
                       {GLFW_KEY_ENTER, 0},
                       kNone,
                       asks,
                       [](Workshop& s) {
                         s.quit_after_saving = true;
                         save(s);
                       }},
                Action{"quit.discard",
                       "Quit without saving",
                       {GLFW_KEY_D, kControl},
                       kNone,
                       asks,
                       [](Workshop& s) { s.done = true; }},
                Action{"quit.cancel", "Go on throwing", kNone, kNone, asks,
                       [](Workshop& s) { close_overlay(s); }},
};

}  // namespace

std::span<const Action> actions() { return kActions; }
std::span<const MenuTitle> menus() { return kMenus; }

const Action* find_action(std::string_view id) {
  const auto* found = std::ranges::find(kActions, id, &Action::id);
  return found == kActions.end() ? nullptr : &*found;
}

const Action* action_of(const KeyChord& chord) {
  if (chord.key == 0) return nullptr;
  const auto* found = std::ranges::find_if(
      kActions, [&](const Action& a) { return a.chord == chord || a.also == chord; });
  return found == kActions.end() ? nullptr : &*found;
}

bool run(const Action& action, Workshop& shop) {
  if (!action.enabled(shop)) return false;
  std::string line = "action: ";
  shop.log(line.append(action.id));
  action.run(shop);
  return true;
}

}  // namespace clay::studio
