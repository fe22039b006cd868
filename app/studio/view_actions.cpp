// How the pot and the window are seen, and help.

#include "app/studio/action_parts.hpp"
#include "app/studio/input.hpp"
#include "app/studio/panels/panels.hpp"

#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>

#include <algorithm>
#include <array>

namespace clay::studio {
namespace {

constexpr unsigned kControlShift = kControl | kShift;
constexpr float kScaleStep = 1.1f;
constexpr KeyChord kNone{};

template <Seen from>
void look(AppState& shop) {
  shop.view.look(shop, from);
}
template <render::Cut cut>
void set_cut(AppState& shop) {
  shop.view.cut = shop.view.cut == cut ? render::Cut::none : cut;
}
template <render::Cut cut>
bool is_cut(const AppState& shop) {
  return shop.view.cut == cut;
}
template <LengthUnit unit>
void set_unit(AppState& shop) {
  shop.settings.unit = unit;
}
template <LengthUnit unit>
bool is_unit(const AppState& shop) {
  return shop.settings.unit == unit;
}
void set_scale(AppState& shop, float scale) {
  shop.settings.scale = std::clamp(scale, kSmallestScale, kLargestScale);
  shop.restyle = true;
}

using A = Action;
const std::array kViewActions = {
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
      set_cut<render::Cut::half>,
      is_cut<render::Cut::half>},
    A{"view.cut_quarter",
      "Cut a quarter",
      {GLFW_KEY_C, kShift},
      kNone,
      has_work,
      set_cut<render::Cut::quarter>,
      is_cut<render::Cut::quarter>},
    A{"view.wall_map",
      "Wall thickness on the pot",
      {GLFW_KEY_W, 0},
      kNone,
      always,
      [](AppState& s) { s.settings.wall_map = !s.settings.wall_map; },
      [](const AppState& s) { return s.settings.wall_map; }},
    A{"view.section",
      "Section",
      {GLFW_KEY_X, 0},
      kNone,
      always,
      [](AppState& s) { toggle_panel(s, "section"); },
      [](const AppState& s) { return panel_open(s, "section"); }},
    A{"view.walls", "Walls", kNone, kNone, always, [](AppState& s) { toggle_panel(s, "walls"); },
      [](const AppState& s) { return panel_open(s, "walls"); }},
    A{"view.certificate", "Certificate", kNone, kNone, always,
      [](AppState& s) { toggle_panel(s, "certificate"); },
      [](const AppState& s) { return panel_open(s, "certificate"); }},
    A{"view.ledger", "Ledger", kNone, kNone, always, [](AppState& s) { toggle_panel(s, "ledger"); },
      [](const AppState& s) { return panel_open(s, "ledger"); }},
    A{"view.stress", "Stress", kNone, kNone, always, [](AppState& s) { toggle_panel(s, "stress"); },
      [](const AppState& s) { return panel_open(s, "stress"); }},
    A{"view.servo", "Servo", kNone, kNone, always, [](AppState& s) { toggle_panel(s, "servo"); },
      [](const AppState& s) { return panel_open(s, "servo"); }},
    A{"view.theme",
      "Light theme",
      {GLFW_KEY_L, kControl},
      kNone,
      always,
      [](AppState& s) {
        s.settings.theme = s.settings.theme == Theme::dark ? Theme::light : Theme::dark;
        s.restyle = true;
      },
      [](const AppState& s) { return s.settings.theme == Theme::light; }},
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
      [](AppState& s) { set_scale(s, s.settings.scale * kScaleStep); }},
    A{"view.smaller",
      "Smaller text",
      {GLFW_KEY_MINUS, kControl},
      kNone,
      always,
      [](AppState& s) { set_scale(s, s.settings.scale / kScaleStep); }},
    A{"help.hint", "First steps below the pot", kNone, kNone, always,
      [](AppState& s) { s.settings.hints = !s.settings.hints; },
      [](const AppState& s) { return s.settings.hints; }},
    A{"help.keys",
      "Keys and mouse",
      {GLFW_KEY_SLASH, kShift},
      {GLFW_KEY_F1, 0},
      always,
      [](AppState& s) { s.overlay = Overlay::shortcuts; }},
};

}  // namespace

std::span<const Action> view_actions() { return kViewActions; }

}  // namespace clay::studio
