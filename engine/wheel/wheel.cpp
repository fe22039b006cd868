#include "claystack/engine/wheel.hpp"

#include "core/text.hpp"
#include "engine/clay/stack_writer.hpp"
#include "engine/clay/start.hpp"
#include "engine/collapse/collapse.hpp"
#include "engine/tick/clay_rules.hpp"
#include "engine/tick/contact.hpp"
#include "engine/tick/force.hpp"
#include "engine/tick/front.hpp"
#include "engine/tick/redistribution.hpp"
#include "engine/tick/removal.hpp"
#include "engine/tick/stability.hpp"
#include "engine/tool/tool_state.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/common.hpp>
#include <optional>
#include <span>
#include <string>
#include <utility>

namespace clay {

struct Wheel::State {
  StepPlan plan;
  ClayStack stack;
  Ledger ledger;
  ToolTracker tracker;
  Rim rim;
  bool touching = false;  // at the last pose
  StabilityWatch watch;
  std::array<ToolRemoval, 2> removals;  // scratch, reserved once; the second is for pinches alone
  Motion motion;                        // of scenes with clay rules, as these two
  RuleWork work;
  RuleSteps rules;
  std::optional<double> turned_mm;  // height of a pot that stands upside down
  ThrowSettings settings;
  // Of the pot that was put on the wheel.
  std::optional<ThrowSettings> settings_before;
  std::optional<ToolSpec> shaped_before;  // the tool that left the marks on its walls
  bool thrown = true;                     // false: no pose yet on the pot that was put on the wheel
  std::optional<Failure> failure;
  glm::dvec3 failure_hip{0.0};
  StepReport (*tick)(State&, const Pose&) noexcept = nullptr;
  StepReport (*probe)(State&, const Pose&) noexcept = nullptr;
};

namespace {

constexpr unsigned kStageSets = 64;

template <unsigned stages>
constexpr Model kModel = (stages & kPaperModel) ? Model::paper : Model::conserving;

/// The rings that the tool touches; of a pinch the outer tool first, then the inner one.
template <unsigned stages, class State>
std::span<ToolRemoval> touch(State& s, const ToolState& tool) noexcept {
  if constexpr (stages & kPinch) {
    if (tool.gap_mm > 0.0) {
      find_pinch<kModel<stages>>(s.plan.tool, s.stack, tool.hip_mm, tool.gap_mm,
                                 s.removals[0].contact, s.removals[1].contact, tool.moved_mm);
      return s.removals;
    }
  }
  find_contact<kModel<stages>>(s.plan.tool, s.stack, tool.hip_mm, s.removals[0].contact,
                               tool.moved_mm);
  return std::span(s.removals).first(1);
}

std::uint32_t rings_of(std::span<const ToolRemoval> removals) noexcept {
  std::size_t rings = 0;
  for (const ToolRemoval& removal : removals) rings += removal.contact.rings.touched();
  return static_cast<std::uint32_t>(rings);
}

/// The paper's tick has one part.
template <Model model>
int parts_of(const ToolState& tool) noexcept {
  return model == Model::paper ? 1 : clay::parts_of(tool);
}

template <unsigned stages, class State>
void remove(State& s, const ToolState& tool, std::span<ToolRemoval> removals) noexcept {
  if constexpr (stages & kPinch) {
    if (removals.size() == 2)
      return compute_pinch_removal<kModel<stages>>(s.plan.removal, s.stack, tool.gap_mm, tool.dt_s,
                                                   removals[0], removals[1]);
  }
  compute_removal<kModel<stages>>(s.plan.removal, s.stack, tool.dt_s, removals[0].contact,
                                  removals[0].removed);
}

/// A sponge ignores the trim button.
template <class State>
bool trims(const State& s, const ToolState& tool) noexcept {
  if (s.plan.mode == ToolMode::smooth) return false;
  return tool.trim || s.plan.mode == ToolMode::trim || s.plan.mode == ToolMode::trim_foot;
}

template <class State>
RulePress rule_press(const State& s, const ToolState& tool) noexcept {
  return {s.plan, tool, s.motion, trims(s, tool)};
}

/// How far the clay gives way, for the stack and for the force.
template <unsigned stages, class State>
void yield(State& s, const ToolState& tool, std::span<ToolRemoval> removals) noexcept {
  if constexpr (stages & kRules)
    s.rules.yield(rule_press(s, tool), s.stack, removals, s.work);
  else
    remove<stages>(s, tool, removals);
  if constexpr ((stages & kForce) && kModel<stages> == Model::conserving)
    for (ToolRemoval& removal : removals)
      measure_front(s.plan, s.stack, tool.hip_mm.y, tool.dt_s, removal.contact);
}

/// Whether the stack still stands after a flow; the flags of both.
template <unsigned stages, class State>
std::uint32_t settle_flow(State& s, const Flow& flow, const ToolState& tool) noexcept {
  if constexpr (stages & kStability) {
    s.failure = s.watch.check(s.plan.stability, s.stack, flow);
    if (s.failure) s.failure_hip = tool.hip_mm;
  }
  return (flow.grown > 0 ? kGrew : 0u) | (flow.ring_limit ? kRingLimit : 0u) |
         (s.failure ? kCollapsed : 0u);
}

/// Moves the displaced clay, and checks whether the stack still stands.
template <unsigned stages, class State>
std::uint32_t deform(State& s, const ToolState& tool,
                     std::span<const ToolRemoval> removals) noexcept {
  const Flow flow = [&] {
    if constexpr (stages & kRules) {
      if constexpr (stages & kStability) s.watch.move_to(s.stack, s.work.highest);
      return s.rules.move(rule_press(s, tool), removals, s.work, s.stack, s.ledger, s.rim);
    } else {
      const std::size_t reach = flow_reach(*s.plan.kernel);
      if constexpr (stages & kStability)
        s.watch.move_to(s.stack, std::min(removals[0].contact.top + reach, s.stack.size() - 1));
      return trims(s, tool) ? trim_clay<kModel<stages>>(removals, s.stack, s.ledger, &s.rim)
                            : press_clay<kModel<stages>>(s.plan, removals, tool.upward, s.stack,
                                                         s.ledger, &s.rim);
    }
  }();

  return settle_flow<stages>(s, flow, tool);
}

/// Clay that a tool prevented from rising becomes rings after the tool has left.
template <unsigned stages, class State>
std::uint32_t raise_crown(State& s, const ToolState& tool) noexcept {
  if (s.stack.crown() < s.stack.rings().back().volume()) return 0;
  Flow flow;
  flow.lowest = flow.highest = s.stack.size() - 1;
  if constexpr (stages & kStability) s.watch.move_to(s.stack, flow.highest);
  Rim* const rim = (s.plan.clay.rules & kRim) ? nullptr : &s.rim;
  {
    StackWriter writer(s.stack);
    grow_rim(flow, s.plan, tool.hip_mm.y, {}, s.stack, rim, writer);
  }
  return settle_flow<stages>(s, flow, tool);
}

/// Clay leaves the touched rings on the tool's way, not at its end: the flow begins from the
/// middle.
template <unsigned stages, class State>
void press(State& s, const ToolState& tool, std::span<ToolRemoval> removals,
           StepReport& report) noexcept {
  const std::uint32_t touched = rings_of(removals);
  if (touched == 0) return;
  report.flags |= kContact;
  report.rings_touched = touched;
  if constexpr (kModel<stages> == Model::conserving) {
    const double half_way = 0.5 * tool.moved_mm.y / s.stack.ring_height_mm();
    removals[0].contact.up_offset += std::max(half_way, 0.0);
    removals[0].contact.down_offset += std::max(-half_way, 0.0);
  }
  yield<stages>(s, tool, removals);
  report.flags |= deform<stages>(s, tool, removals);
}

template <unsigned stages>
void add_force(const ForcePlan& plan, std::span<const ToolRemoval> removals,
               StepReport& report) noexcept {
  const auto add = [&](const Contact& contact) {
    const glm::dvec3 spring = spring_force<kModel<stages>>(plan, contact);
    report.spring_n += spring;
    if constexpr (stages & kFriction) report.friction_n += friction_force(plan, contact, spring);
  };
  add(removals[0].contact);
  if constexpr (stages & kPinch)
    if (removals.size() == 2) add(removals[1].contact);
  limit_sum(report.spring_n, report.friction_n, plan.limit_n);
}

/// The tool at a pose, with its gap; not valid where the pose is refused.
template <unsigned stages>
ToolState track_tool(const StepPlan& plan, ToolTracker& tracker, const Pose& pose,
                     StepReport& report) noexcept {
  ToolState tool = tracker.advance(pose, (stages & kPinch) ? kFarthestMm : 0.0);
  report.flags = (tool.valid ? 0u : kRefused) | (tool.dt_clamped ? kLongStep : 0u);
  if constexpr (stages & kPinch)
    if (tool.gap_mm == 0.0) tool.gap_mm = plan.gap_mm;
  return tool;
}

/// The tick for a set of stages. Its code omits the stages that the scene does not need.
template <unsigned stages, class State>
StepReport tick(State& s, const Pose& pose) noexcept {
  StepReport report;
  if (s.failure) {
    report.flags = kCollapsed;
    return report;
  }
  ToolState tool = track_tool<stages>(s.plan, s.tracker, pose, report);
  if (!tool.valid) return report;
  std::span<ToolRemoval> removals = touch<stages>(s, tool);
  const bool touches = rings_of(removals) > 0;
  if constexpr (stages & kRules) follow(s.motion, tool);
  if constexpr (stages & kRules)
    if (!touches) report.flags |= raise_crown<stages>(s, tool);
  const int parts = touches || s.touching ? parts_of<kModel<stages>>(tool) : 1;
  s.touching = touches;
  tool.dt_s /= parts;
  tool.moved_mm /= parts;
  const glm::dvec3 end_mm = tool.hip_mm;
  const double end_phase_s = tool.phase_s, slow_s = tool.slow_s;
  for (int part = 1; part <= parts && !s.failure; ++part) {
    tool.hip_mm = end_mm - static_cast<double>(parts - part) * tool.moved_mm;
    tool.phase_s = end_phase_s - static_cast<double>(parts - part) * tool.dt_s;
    tool.slow_s = part < parts ? 0.0 : slow_s;
    if (parts > 1) removals = touch<stages>(s, tool);
    press<stages>(s, tool, removals, report);
  }
  if constexpr (stages & kForce)
    // After a collapse nothing is left to push against.
    if (!s.failure && rings_of(removals) > 0) add_force<stages>(s.plan.force, removals, report);
  return report;
}

/// Only the force of a tick: with the contact that the last part of the tick would find.
template <unsigned stages, class State>
StepReport probe(State& s, const Pose& pose) noexcept {
  StepReport report;
  if (s.failure) {
    report.flags = kCollapsed;
    return report;
  }
  ToolTracker tracker = s.tracker;
  ToolState tool = track_tool<stages>(s.plan, tracker, pose, report);
  if (!tool.valid) return report;
  [[maybe_unused]] const ToolState whole = tool;
  const int parts = parts_of<kModel<stages>>(tool);
  tool.dt_s /= parts;
  tool.moved_mm /= parts;
  const std::span<ToolRemoval> removals = touch<stages>(s, tool);
  report.rings_touched = rings_of(removals);
  if (report.rings_touched == 0) return report;
  report.flags |= kContact;
  if constexpr (stages & kForce) {
    if constexpr (kModel<stages> == Model::conserving) {
      const Motion before = s.motion;
      if constexpr (stages & kRules) follow(s.motion, whole);
      yield<stages>(s, tool, removals);
      s.motion = before;
    }
    add_force<stages>(s.plan.force, removals, report);
  }
  return report;
}

// From the axis, where there is no bore: counts as through.
constexpr double kThroughMm = 2.0;

/// Whether a point at this height is beyond the wall, seen from outside.
bool through_wall(const Ring& ring, const glm::dvec3& hip_mm) noexcept {
  const double d = std::sqrt(hip_mm.x * hip_mm.x + hip_mm.z * hip_mm.z);
  return d <= std::max(ring.inner_mm(), kThroughMm);
}

/// The tick of a needle or a wire. It cuts once, between the nearest rings, when the HIP goes
/// through the wall. At least one ring stays.
template <bool probes, class State>
StepReport cut_tick(State& s, const Pose& pose) noexcept {
  StepReport report;
  ToolTracker tracker = s.tracker;
  const ToolState tool = tracker.advance(pose, kFarthestMm);
  if constexpr (!probes) s.tracker = tracker;
  report.flags = (tool.valid ? 0u : kRefused) | (tool.dt_clamped ? kLongStep : 0u);
  const auto rings = s.stack.rings();
  const double level = tool.hip_mm.y / s.stack.ring_height_mm();
  if (!tool.valid || !(level >= 0.0 && level < static_cast<double>(rings.size()))) return report;
  const Ring& ring = rings[static_cast<std::size_t>(level)];
  const glm::dvec3 &now = tool.hip_mm, before = now - tool.moved_mm;
  if (now.x * now.x + now.z * now.z >= mm2_from_quanta(ring.outer2)) return report;
  report.flags |= kContact;
  report.rings_touched = 1;
  if constexpr (probes) return report;
  const auto cut = static_cast<std::size_t>(level + 0.5);
  if (!through_wall(ring, now) || through_wall(ring, before) || cut == 0 || cut >= rings.size())
    return report;
  StackWriter writer(s.stack);
  s.ledger.trimmed +=
      s.plan.mode == ToolMode::needle ? writer.cut_above(cut) : writer.cut_below(cut);
  s.rim = {};
  report.flags |= kCut;
  return report;
}

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

template <class State, std::size_t... sets>
constexpr auto tick_table(std::index_sequence<sets...>) {
  return std::array{&tick<static_cast<unsigned>(sets), State>...};
}

template <class State, std::size_t... sets>
constexpr auto probe_table(std::index_sequence<sets...>) {
  return std::array{&probe<static_cast<unsigned>(sets), State>...};
}

/// The tool that left the marks on the walls of a pot.
std::optional<ToolSpec> shaping_tool(const Pot& pot) {
  if (pot.shaped_with || !pot.thrown_with || cuts_level(pot.thrown_with->tool.mode))
    return pot.shaped_with;
  return pot.thrown_with->tool;
}

}  // namespace

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
      return failure(ErrorKind::bad_input, "stability.max_stress_kpa: expected more than the " +
                                               clay + "'s own weight, found " +
                                               number_text(plan.stability.max_stress_kpa) +
                                               " against " + number_text(weak->stress_kpa) +
                                               " kPa at ring " + std::to_string(weak->ring));
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
  static constexpr auto kTicks = tick_table<State>(std::make_index_sequence<kStageSets>{});
  static constexpr auto kProbes = probe_table<State>(std::make_index_sequence<kStageSets>{});
  if (state->plan.stages & kRules) {
    state->work.reserve(state->plan.tool, state->stack);
    state->rules =
        state->plan.mode == ToolMode::smooth ? sponge_steps() : rule_steps(state->plan.clay.rules);
  }
  state->tick = kTicks[state->plan.stages];
  state->probe = kProbes[state->plan.stages];
  if (cuts_level(state->plan.mode)) {
    state->tick = &cut_tick<false, State>;
    state->probe = &cut_tick<true, State>;
  }
  if (state->plan.mode == ToolMode::trim_foot) state->turned_mm = state->stack.height_mm();
  return Wheel(std::move(state));
}

StepReport Wheel::step(const Pose& pose) noexcept {
  State& s = *state_;
  s.thrown = true;
  return s.turned_mm ? turned(s.tick(s, turned(pose, *s.turned_mm))) : s.tick(s, pose);
}
StepReport Wheel::probe(const Pose& pose) noexcept {
  State& s = *state_;
  return s.turned_mm ? turned(s.probe(s, turned(pose, *s.turned_mm))) : s.probe(s, pose);
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
    pot.collapse = settle(s.stack, s.plan.density_g_cm3, *s.failure, s.failure_hip,
                          s.plan.stability.max_stress_kpa);
  return pot;
}

}  // namespace clay
