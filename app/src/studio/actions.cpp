#include "studio/actions.hpp"

#include "studio/action_parts.hpp"
#include "studio/input.hpp"
#include "studio/panels/panels.hpp"

#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>

#include <algorithm>
#include <array>
#include <vector>

namespace clay::studio {
namespace {

constexpr unsigned kControlShift = kControl | kShift;
constexpr double kSizeStep = 1.1;
constexpr float kScaleStep = 1.1f;

/// The export is in: there are figures to show.
bool can_check(const Workshop&) { return !process_names().empty(); }
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
void set_scale(Workshop& shop, float scale) {
  shop.settings.scale = std::clamp(scale, kSmallestScale, kLargestScale);
  shop.restyle = true;
}

void pause(Workshop& shop) {
  shop.paused = !shop.paused;
  shop.potter.command({live::CommandKind::pause, shop.paused ? 1.0 : 0.0});
}

/// Esc: out of what is open, else no force in this very moment.
void back(Workshop& shop) {
  if (shop.view.sizing()) return shop.view.cancel(shop);
  if (shop.overlay != Overlay::none) return close_overlay(shop);
  if (shop.potter.scrubbing()) return shop.potter.show_present();
  if (shop.potter.throwing() && !shop.potter.has_device()) return shop.potter.release();
  if (shop.potter.throwing()) return pause(shop);
  shop.notices.close();
}

constexpr std::array kMenus = {MenuTitle{"file.", "File"}, MenuTitle{"edit.", "Edit"},
                               MenuTitle{"tool.", "Tool"}, MenuTitle{"wheel.", "Wheel"},
                               MenuTitle{"view.", "View"}, MenuTitle{"help.", "Help"}};

constexpr KeyChord kNone{};

using A = Action;
const std::array kActions = {
    A{"tool.press",
      "Press",
      {GLFW_KEY_P, 0},
      kNone,
      always,
      set_mode<ToolMode::press>,
      is_mode<ToolMode::press>},
    A{"tool.trim",
      "Trim",
      {GLFW_KEY_T, 0},
      kNone,
      always,
      set_mode<ToolMode::trim>,
      is_mode<ToolMode::trim>},
    A{"tool.pinch",
      "Pinch",
      {GLFW_KEY_H, 0},
      kNone,
      always,
      set_mode<ToolMode::pinch>,
      is_mode<ToolMode::pinch>},
    A{"tool.sphere",
      "Sphere",
      {GLFW_KEY_S, 0},
      kNone,
      always,
      set_shape<Shape::sphere>,
      is_shape<Shape::sphere>},
    A{"tool.ellipse",
      "Ellipse",
      {GLFW_KEY_E, 0},
      kNone,
      always,
      set_shape<Shape::ellipse>,
      is_shape<Shape::ellipse>},
    A{"tool.rib",
      "Rib",
      {GLFW_KEY_R, 0},
      kNone,
      always,
      set_shape<Shape::rib>,
      is_shape<Shape::rib>},
    A{"tool.smaller",
      "Smaller",
      {GLFW_KEY_LEFT_BRACKET, 0},
      kNone,
      always,
      [](Workshop& s) { resize(s.settings.tool, 1.0 / kSizeStep); }},
    A{"tool.larger",
      "Larger",
      {GLFW_KEY_RIGHT_BRACKET, 0},
      kNone,
      always,
      [](Workshop& s) { resize(s.settings.tool, kSizeStep); }},
    A{"tool.size",
      "Set size with the mouse",
      {GLFW_KEY_F, 0},
      kNone,
      at_rest,
      [](Workshop& s) { s.view.begin_sizing(s); }},
    A{"tool.strength",
      "Set stiffness with the mouse",
      {GLFW_KEY_F, kShift},
      kNone,
      at_rest,
      [](Workshop& s) { s.view.begin_strength(s); }},
    A{"tool.narrower",
      "Narrower gap",
      {GLFW_KEY_COMMA, 0},
      kNone,
      pinching,
      [](Workshop& s) {
        s.settings.tool.gap_mm = std::max(kNarrowestGapMm, s.settings.tool.gap_mm - 0.5);
      }},
    A{"tool.wider",
      "Wider gap",
      {GLFW_KEY_PERIOD, 0},
      kNone,
      pinching,
      [](Workshop& s) {
        s.settings.tool.gap_mm = std::min(kWidestPinchMm, s.settings.tool.gap_mm + 0.5);
      }},
    A{"wheel.pause",
      "Pause",
      {GLFW_KEY_SPACE, 0},
      kNone,
      has_work,
      pause,
      [](const Workshop& s) { return s.paused; }},
    A{"wheel.rearm",
      "Force again",
      {GLFW_KEY_R, kShift},
      kNone,
      waits_for_rearm,
      [](Workshop& s) {
        s.potter.command({live::CommandKind::rearm, 0.0});
      }},
    A{"wheel.zero_force", "Zero force, or back", {GLFW_KEY_ESCAPE, 0}, kNone, always, back},
    A{"view.home", "Whole pot", {GLFW_KEY_HOME, 0}, kNone, has_work, look<Seen::home>},
    A{"view.front",
      "From the front",
      {GLFW_KEY_1, 0},
      {GLFW_KEY_KP_1, 0},
      has_work,
      look<Seen::front>},
    A{"view.right",
      "From the right",
      {GLFW_KEY_3, 0},
      {GLFW_KEY_KP_3, 0},
      has_work,
      look<Seen::right>},
    A{"view.top", "From above", {GLFW_KEY_7, 0}, {GLFW_KEY_KP_7, 0}, has_work, look<Seen::top>},
    A{"view.cut_half",
      "Cut in half",
      {GLFW_KEY_C, 0},
      kNone,
      has_work,
      set_cut<draw::Cut::half>,
      is_cut<draw::Cut::half>},
    A{"view.cut_quarter",
      "Cut a quarter",
      {GLFW_KEY_C, kShift},
      kNone,
      has_work,
      set_cut<draw::Cut::quarter>,
      is_cut<draw::Cut::quarter>},
    A{"view.wall_map",
      "Wall thickness on the pot",
      {GLFW_KEY_W, 0},
      kNone,
      can_check,
      [](Workshop& s) { s.settings.wall_map = !s.settings.wall_map; },
      [](const Workshop& s) { return s.settings.wall_map; }},
    A{"view.section",
      "Section",
      {GLFW_KEY_X, 0},
      kNone,
      always,
      [](Workshop& s) { toggle_panel(s, "section"); },
      [](const Workshop& s) { return panel_open(s, "section"); }},
    A{"view.walls", "Walls", kNone, kNone, can_check, [](Workshop& s) { toggle_panel(s, "walls"); },
      [](const Workshop& s) { return panel_open(s, "walls"); }},
    A{"view.certificate", "Certificate", kNone, kNone, can_check,
      [](Workshop& s) { toggle_panel(s, "certificate"); },
      [](const Workshop& s) { return panel_open(s, "certificate"); }},
    A{"view.ledger", "Ledger", kNone, kNone, always, [](Workshop& s) { toggle_panel(s, "ledger"); },
      [](const Workshop& s) { return panel_open(s, "ledger"); }},
    A{"view.stress", "Stress", kNone, kNone, always, [](Workshop& s) { toggle_panel(s, "stress"); },
      [](const Workshop& s) { return panel_open(s, "stress"); }},
    A{"view.servo", "Servo", kNone, kNone, always, [](Workshop& s) { toggle_panel(s, "servo"); },
      [](const Workshop& s) { return panel_open(s, "servo"); }},
    A{"view.theme",
      "Light theme",
      {GLFW_KEY_L, kControl},
      kNone,
      always,
      [](Workshop& s) {
        s.settings.theme = s.settings.theme == Theme::dark ? Theme::light : Theme::dark;
        s.restyle = true;
      },
      [](const Workshop& s) { return s.settings.theme == Theme::light; }},
    A{"view.mm", "Millimetres", kNone, kNone, always, set_unit<LengthUnit::mm>,
      is_unit<LengthUnit::mm>},
    A{"view.cm", "Centimetres", kNone, kNone, always, set_unit<LengthUnit::cm>,
      is_unit<LengthUnit::cm>},
    A{"view.in", "Inches", kNone, kNone, always, set_unit<LengthUnit::in>, is_unit<LengthUnit::in>},
    A{"view.larger",
      "Larger text",
      {GLFW_KEY_EQUAL, kControl},
      {GLFW_KEY_EQUAL, kControlShift},
      always,
      [](Workshop& s) { set_scale(s, s.settings.scale * kScaleStep); }},
    A{"view.smaller",
      "Smaller text",
      {GLFW_KEY_MINUS, kControl},
      kNone,
      always,
      [](Workshop& s) { set_scale(s, s.settings.scale / kScaleStep); }},
    A{"help.hint", "First steps below the pot", kNone, kNone, always,
      [](Workshop& s) { s.settings.hints = !s.settings.hints; },
      [](const Workshop& s) { return s.settings.hints; }},
    A{"help.keys",
      "Keys and mouse",
      {GLFW_KEY_SLASH, kShift},
      {GLFW_KEY_F1, 0},
      always,
      [](Workshop& s) { s.overlay = Overlay::shortcuts; }},
};

}  // namespace

std::span<const Action> actions() {
  static const std::vector<Action> all = [] {
    std::vector<Action> joined(file_actions().begin(), file_actions().end());
    joined.insert(joined.end(), kActions.begin(), kActions.end());
    return joined;
  }();
  return all;
}
std::span<const MenuTitle> menus() { return kMenus; }

const Action* find_action(std::string_view id) {
  const auto found = std::ranges::find(actions(), id, &Action::id);
  return found == actions().end() ? nullptr : &*found;
}

const Action* action_of(const KeyChord& chord) {
  if (chord.key == 0) return nullptr;
  const auto found = std::ranges::find_if(
      actions(), [&](const Action& a) { return a.chord == chord || a.also == chord; });
  return found == actions().end() ? nullptr : &*found;
}

bool run(const Action& action, Workshop& shop) {
  if (!action.enabled(shop)) return false;
  std::string line = "action: ";
  shop.log(line.append(action.id));
  action.run(shop);
  return true;
}

}  // namespace clay::studio
