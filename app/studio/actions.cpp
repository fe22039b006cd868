#include "app/studio/actions.hpp"

#include "app/studio/action_parts.hpp"
#include "app/studio/input.hpp"

#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>

#include <algorithm>
#include <array>
#include <vector>

namespace clay::studio {
namespace {

constexpr double kSizeStep = 1.1;

bool pinching(const AppState& shop) { return shop.settings.tool.mode == ToolMode::pinch; }

template <ToolMode mode>
void set_mode(AppState& shop) {
  shop.settings.tool.mode = mode;
}
template <ToolMode mode>
bool is_mode(const AppState& shop) {
  return shop.settings.tool.mode == mode;
}
template <Shape shape>
void set_shape(AppState& shop) {
  shop.settings.tool.shape = shape;
}
template <Shape shape>
bool is_shape(const AppState& shop) {
  return shop.settings.tool.shape == shape;
}

/// Esc: no force in this very moment, whatever is open, and out of that too. However often it is
/// pressed, it gives no force back.
void back(AppState& shop) {
  const bool felt = shop.potter.has_device() && has_work(shop) && !shop.potter.paused();
  if (felt) shop.potter.pause(true);
  if (shop.view.sizing()) return shop.view.cancel(shop);
  if (shop.overlay != Overlay::none) return close_overlay(shop);
  if (shop.potter.scrubbing()) return shop.potter.show_present();
  if (shop.potter.throwing() && !shop.potter.has_device()) return shop.potter.release();
  if (!felt) shop.notices.close();
}

constexpr std::array kMenus = {MenuTitle{"file.", "File"}, MenuTitle{"edit.", "Edit"},
                               MenuTitle{"tool.", "Tool"}, MenuTitle{"wheel.", "Wheel"},
                               MenuTitle{"view.", "View"}, MenuTitle{"help.", "Help"}};

constexpr KeyChord kNone{};

using A = Action;
const std::array kThrowingActions = {
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
      [](AppState& s) { resize(s.settings.tool, 1.0 / kSizeStep); }},
    A{"tool.larger",
      "Larger",
      {GLFW_KEY_RIGHT_BRACKET, 0},
      kNone,
      always,
      [](AppState& s) { resize(s.settings.tool, kSizeStep); }},
    A{"tool.size",
      "Set size with the mouse",
      {GLFW_KEY_F, 0},
      kNone,
      at_rest,
      [](AppState& s) { s.view.begin_sizing(s); }},
    A{"tool.strength",
      "Set stiffness with the mouse",
      {GLFW_KEY_F, kShift},
      kNone,
      at_rest,
      [](AppState& s) { s.view.begin_strength(s); }},
    A{"tool.narrower",
      "Narrower gap",
      {GLFW_KEY_COMMA, 0},
      kNone,
      pinching,
      [](AppState& s) {
        s.settings.tool.gap_mm = std::max(kNarrowestGapMm, s.settings.tool.gap_mm - 0.5);
      }},
    A{"tool.wider",
      "Wider gap",
      {GLFW_KEY_PERIOD, 0},
      kNone,
      pinching,
      [](AppState& s) {
        s.settings.tool.gap_mm = std::min(kWidestPinchMm, s.settings.tool.gap_mm + 0.5);
      }},
    A{"wheel.pause",
      "Pause",
      {GLFW_KEY_SPACE, 0},
      kNone,
      has_work,
      [](AppState& s) { s.potter.pause(!s.potter.paused()); },
      [](const AppState& s) { return s.potter.paused(); }},
    A{"wheel.rearm",
      "Force again",
      {GLFW_KEY_R, kShift},
      kNone,
      waits_for_rearm,
      [](AppState& s) {
        s.potter.command({servo::CommandKind::rearm, 0.0});
      }},
    A{"wheel.zero_force", "Zero force, or back", {GLFW_KEY_ESCAPE, 0}, kNone, always, back},
};

}  // namespace

std::span<const Action> actions() {
  static const std::vector<Action> all = [] {
    std::vector<Action> joined(file_actions().begin(), file_actions().end());
    joined.insert(joined.end(), kThrowingActions.begin(), kThrowingActions.end());
    joined.insert(joined.end(), view_actions().begin(), view_actions().end());
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

bool run(const Action& action, AppState& shop) {
  if (!action.enabled(shop)) return false;
  std::string line = "action: ";
  shop.log(line.append(action.id));
  action.run(shop);
  return true;
}

}  // namespace clay::studio
