#include "claystack/engine/wheel.hpp"

#include "core/text.hpp"
#include "engine/clay/stack_writer.hpp"
#include "engine/clay/start.hpp"
#include "engine/tick/contact.hpp"
#include "engine/wheel/wheel_state.hpp"

#include <array>
#include <optional>
#include <span>
#include <string>
#include <utility>

namespace clay {
namespace {

/// Turns a pose, or a force, of a hand at a pot that stands upside down.
Pose turned(Pose pose, double height_mm) noexcept {
  pose.position_mm.y = height_mm - pose.position_mm.y;
  return pose;
}
StepReport turned(StepReport report) noexcept {
  report.spring_n.y = -report.spring_n.y;
  report.friction_n.y = -report.friction_n.y;
  return report;
}

/// The tool that left the marks on the walls of a pot.
std::optional<ToolSpec> shaping_tool(const Pot& pot) {
  if (pot.shaped_with || !pot.thrown_with || cuts_level(pot.thrown_with->tool.mode))
    return pot.shaped_with;
  return pot.thrown_with->tool;
}

}  // namespace

struct Wheel::State : WheelState {};

Wheel::Wheel(std::unique_ptr<State> state) noexcept : state_(std::move(state)) {}
Wheel::Wheel(Wheel&&) noexcept = default;
Wheel& Wheel::operator=(Wheel&&) noexcept = default;
Wheel::~Wheel() = default;

Result<Wheel> Wheel::build(const SceneSpec& scene) {
  auto plan = StepPlan::build(scene);
  if (!plan) return tl::make_unexpected(plan.error());
  const LumpSpec& lump = scene.lump;
  auto stack = ClayStack::cylinder(lump.rings, lump.ring_height_mm, lump.outer_radius_mm,
                                   lump.inner_radius_mm, max_rings_of(lump));
  if (!stack) return failure(stack.error().kind, "lump: " + stack.error().message);
  const Ledger ledger{.initial = stack->volume(), .added = 0, .trimmed = 0, .outside = 0};
  auto wheel = assemble(std::move(*plan), std::move(*stack), ledger, Rim{}, "lump");
  if (wheel) wheel->state_->settings = settings_of(scene);
  return wheel;
}

Result<Wheel> Wheel::build(const SceneSpec& scene, const Pot& start) {
  if (auto fits = check_start(scene, start); !fits) return tl::make_unexpected(fits.error());
  SceneSpec own = scene;
  LumpSpec& lump = own.lump;
  lump.rings = start.stack.size();
  lump.ring_height_mm = start.stack.ring_height_mm();
  if (lump.max_rings == 0) lump.max_rings = start.stack.max_rings();
  auto plan = StepPlan::build(own);
  if (!plan) return tl::make_unexpected(plan.error());
  const auto rings = start.stack.rings();
  auto stack = ClayStack::from_rings(lump.ring_height_mm, {rings.begin(), rings.end()},
                                     start.stack.crown(), lump.max_rings);
  if (!stack) return failure(stack.error().kind, "pot: " + stack.error().message);
  auto wheel = assemble(std::move(*plan), std::move(*stack), start.ledger, start.rim, "pot");
  if (!wheel) return wheel;
  State& state = *wheel->state_;
  if (scene.clay) state.motion = start.motion;
  state.settings = settings_of(scene);
  state.settings_before = start.thrown_with;
  state.shaped_before = shaping_tool(start);
  state.thrown = false;
  return wheel;
}

Result<Wheel> Wheel::assemble(StepPlan plan, ClayStack stack, const Ledger& ledger, const Rim& rim,
                              const std::string& clay) {
  if (plan.stages & kStability) {
    if (const auto weak = StabilityWatch::check_all(plan.stability, stack))
      return failure(ErrorKind::bad_input,
                     "stability.max_stress_kpa: expected more than " +
                         short_number_text(weak->stress_kpa) + ", the stress under the " + clay +
                         "'s own weight at ring " + std::to_string(weak->ring) + ", found " +
                         number_text(plan.stability.max_stress_kpa));
  }

  auto state = std::make_unique<State>();
  const std::size_t touches = most_contacts(plan.tool, stack.ring_height_mm(), stack.max_rings());
  state->plan = std::move(plan);
  state->stack = std::move(stack);
  StackWriter(state->stack).reserve();
  if (state->plan.stages & kStability) state->watch = StabilityWatch(state->stack);
  state->ledger = ledger;
  state->rim = rim;
  const std::size_t tools = (state->plan.stages & kPinch) ? 2 : 1;
  for (ToolRemoval& removal : std::span(state->removals).first(tools)) {
    removal.contact.rings.reserve(touches);
    removal.removed.reserve(touches);
  }
  if (state->plan.stages & kRules) {
    state->work.reserve(state->plan.tool, state->stack);
    state->rules =
        state->plan.mode == ToolMode::smooth ? sponge_steps() : rule_steps(state->plan.clay.rules);
  }
  state->tick = cuts_level(state->plan.mode) ? cut_tick() : press_tick(state->plan.stages);
  if (state->plan.mode == ToolMode::trim_foot) state->turned_mm = state->stack.height_mm();
  return Wheel(std::move(state));
}

StepReport Wheel::step(const Pose& pose) noexcept {
  State& s = *state_;
  s.thrown = true;
  return s.turned_mm ? turned(s.tick.step(s, turned(pose, *s.turned_mm))) : s.tick.step(s, pose);
}
StepReport Wheel::probe(const Pose& pose) noexcept {
  State& s = *state_;
  return s.turned_mm ? turned(s.tick.probe(s, turned(pose, *s.turned_mm))) : s.tick.probe(s, pose);
}

const StepPlan& Wheel::plan() const noexcept { return state_->plan; }
const ClayStack& Wheel::stack() const noexcept { return state_->stack; }
const Ledger& Wheel::ledger() const noexcept { return state_->ledger; }
bool Wheel::collapsed() const noexcept { return state_->failure.has_value(); }

Pot Wheel::pot() const {
  const State& s = *state_;
  Pot pot{s.stack, s.ledger, s.plan.model, s.plan.density_g_cm3, {}, {}, {}, s.motion};
  if (pot.model == Model::conserving) pot.rim = s.rim;
  pot.thrown_with = s.thrown ? s.settings : s.settings_before;
  if (pot.thrown_with && cuts_level(pot.thrown_with->tool.mode)) pot.shaped_with = s.shaped_before;
  if (s.failure)
    pot.collapse = settle(s.stack, s.plan.density_g_cm3, *s.failure, s.failure_hip_mm,
                          s.plan.stability.max_stress_kpa);
  return pot;
}

}  // namespace clay
