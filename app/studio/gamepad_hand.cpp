#include "app/studio/gamepad_hand.hpp"

#include "app/studio/app_state.hpp"
#include "claystack/falcon/usb.hpp"

#include <algorithm>
#include <glm/geometric.hpp>

namespace clay::studio {
namespace {

constexpr double kLongestFrameS = 0.1;

/// Part of the full speed.
glm::dvec2 rate_of(glm::dvec2 stick) {
  return glm::dvec2(falcon::rate_of(glm::dvec3(stick, 0.0), kStickDeadZone));
}

bool at_rest(glm::dvec2 rate) { return rate == glm::dvec2(0.0); }

double pulled(double trigger) {
  return std::clamp((trigger - kPressUntil) / (1.0 - kPressUntil), 0.0, 1.0);
}

/// Start of the hand if the pointer is not over the view.
glm::dvec2 beside(const render::PotView& pot) {
  constexpr double kBesideMm = 30.0;
  return {render::extent_of(pot).radius_mm + kBesideMm, 0.5 * pot.height_mm};
}

}  // namespace

bool GamepadHand::moving() const noexcept {
  return !at_rest(rate_of(pad_.left_stick)) || !at_rest(rate_of(pad_.right_stick));
}

/// Strength of the hand: in a pinch, the left trigger closes the gap.
double GamepadHand::strength() const noexcept {
  return pulled(pinching_ ? pad_.left_trigger : pad_.right_trigger);
}

void GamepadHand::advance(AppState& state) {
  const double now_s = state.now_s();
  const double elapsed_s = std::clamp(now_s - last_s_, 0.0, kLongestFrameS);
  last_s_ = now_s;
  if (pressing_ && !state.stroke.throwing()) pressing_ = false;  // the stroke was ended elsewhere
  const bool usable = !name_.empty() && state.document.has_work() && state.ui.shows<NoDialog>();
  if (!usable) return end(state);
  if (!view_model(state).view_is_held())
    state.scene.turn(kStickRadPerS * elapsed_s * rate_of(pad_.right_stick));
  press(state);
  const glm::dvec2 step_mm = kStickMmPerS * elapsed_s * rate_of(pad_.left_stick);
  if (pressing_)
    shape(state, step_mm);
  else if (!at_rest(step_mm))
    lead(state, step_mm);
}

void GamepadHand::press(AppState& state) {
  const double way = pad_.right_trigger;
  if (way <= kPressUntil) {
    ready_ = true;
    end(state);
  } else if (ready_ && way >= kPressFrom) {
    ready_ = false;
    begin(state);
  }
}

void GamepadHand::begin(AppState& state) {
  apply(state, StopShowing{});
  if (state.stroke.throwing()) return;
  lead(state, glm::dvec2(0.0));
  const auto place_mm = state.scene.pointed_mm();
  if (!place_mm) return;
  const ToolMode mode = state.settings.tool.mode;
  pinching_ = pad_.left_trigger >= kPressFrom && !cuts_level(mode) && mode != ToolMode::trim_foot;
  Actions actions;
  state.scene.shape_from(view_model(state), *place_mm, {.strength = strength(), .pinch = pinching_},
                         actions);
  apply_all(state, actions);
  pressing_ = state.stroke.throwing() && !state.stroke.has_device();
}

void GamepadHand::end(AppState& state) {
  if (std::exchange(pressing_, false)) apply(state, ReleaseTool{});
}

/// Moves the tool beside the clay: it slides along the surface and never passes through a wall.
void GamepadHand::lead(AppState& state, glm::dvec2 step_mm) const {
  SceneView& scene = state.scene;
  const bool in_view = scene.rect().holds(scene.pointer_px());
  const auto pointed_mm = in_view ? scene.pointed_mm() : std::nullopt;
  const glm::dvec2 from = pointed_mm.value_or(beside(state.stroke.view()));
  const glm::dvec2 to = scene.free_at(view_model(state), from + step_mm);
  const auto pixel = scene.pixel_of(to);
  if (!pointed_mm || (pixel && scene.rect().holds(*pixel))) scene.lead(to);
}

/// Moves the target of the tool, but not further ahead of the tool than the leash.
void GamepadHand::shape(AppState& state, glm::dvec2 step_mm) const {
  const auto pointed_mm = state.scene.pointed_mm();
  if (!pointed_mm) return;
  const servo::LiveStatus& status = state.stroke.status();
  const glm::dvec2 target_mm = state.scene.target_mm(*pointed_mm);
  if (status.ticks > 0) {
    const glm::dvec2 ahead = target_mm - state.scene.in_section(status.tool_mm);
    const double away = glm::dot(step_mm, ahead);
    if (away > 0.0 && glm::length(ahead) > kLeashMm)
      step_mm -= away / glm::dot(ahead, ahead) * ahead;
  }
  step_mm.y = std::max(step_mm.y, -target_mm.y);  // not below the wheel
  state.scene.lead(*pointed_mm + step_mm);
  Actions actions;
  state.scene.shape_to(view_model(state), *pointed_mm + step_mm,
                       {.strength = strength(), .pinch = pinching_}, actions);
  apply_all(state, actions);
}

}  // namespace clay::studio
