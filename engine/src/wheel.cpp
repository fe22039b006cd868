#include "claystack/engine/wheel.hpp"

#include "collapse.hpp"
#include "contact.hpp"
#include "force.hpp"
#include "number_text.hpp"
#include "redistribution.hpp"
#include "removal.hpp"
#include "stability.hpp"
#include "stack_writer.hpp"
#include "tool_state.hpp"

#include <algorithm>
#include <array>
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
  StabilityWatch watch;
  std::array<Bite, 2> bites;  // scratch, reserved once; the second is for pinches alone
  std::optional<Failure> failure;
  glm::dvec3 failure_hip{0.0};
  StepReport (*tick)(State&, const Pose&) noexcept = nullptr;
  StepReport (*feel)(State&, const Pose&) noexcept = nullptr;
};

namespace {

template <unsigned stages>
constexpr Model kModel = (stages & kPaperModel) ? Model::paper : Model::conserving;

/// What the tool touches; of a pinch the outer tool first, then the inner one.
template <unsigned stages, class State>
std::span<Bite> touch(State& s, const ToolState& tool) noexcept {
  if constexpr (stages & kPinch) {
    if (tool.gap_mm > 0.0) {
      find_pinch(s.plan.tool, s.stack, tool.hip_mm, tool.gap_mm, s.bites[0].contact,
                 s.bites[1].contact);
      return s.bites;
    }
  }
  find_contact(s.plan.tool, s.stack, tool.hip_mm, s.bites[0].contact);
  return std::span(s.bites).first(1);
}

template <unsigned stages, class State>
void remove(State& s, const ToolState& tool, std::span<Bite> bites) noexcept {
  if constexpr (stages & kPinch) {
    if (bites.size() == 2)
      return compute_pinch_removal<kModel<stages>>(s.plan.removal, s.stack, tool.gap_mm, tool.dt_s,
                                                   bites[0], bites[1]);
  }
  compute_removal<kModel<stages>>(s.plan.removal, s.stack, bites[0].contact, tool.dt_s,
                                  bites[0].removed);
}

/// Moves the clay that is displaced, and sees whether the stack still stands.
template <unsigned stages, class State>
std::uint32_t deform(State& s, const ToolState& tool, std::span<const Bite> bites) noexcept {
  if constexpr (stages & kStability)
    s.watch.move_to(s.stack,
                    std::min(bites[0].contact.top + s.plan.kernel.length(), s.stack.size() - 1));

  const bool trim = tool.trim || s.plan.mode == ToolMode::trim;
  const Flow flow = trim
                        ? trim_clay<kModel<stages>>(bites, s.stack, s.ledger)
                        : press_clay<kModel<stages>>(s.plan, bites, tool.upward, s.stack, s.ledger);

  if constexpr (stages & kStability) {
    s.failure = s.watch.check(s.plan.stability, s.stack, flow.lowest, flow.grown);
    if (s.failure) s.failure_hip = tool.hip_mm;
  }
  return (flow.grown > 0 ? kGrew : 0u) | (flow.ring_limit ? kRingLimit : 0u) |
         (s.failure ? kCollapsed : 0u);
}

template <unsigned stages>
glm::dvec3 felt(const ForcePlan& plan, std::span<const Bite> bites) noexcept {
  const auto felt_from = [&](const Contact& contact) {
    glm::dvec3 force = spring_force<kModel<stages>>(plan, contact);
    if constexpr (stages & kFriction) force += friction_force(plan, contact, force);
    return force;
  };
  glm::dvec3 force = felt_from(bites[0].contact);
  if constexpr (stages & kPinch)
    if (bites.size() == 2) force += felt_from(bites[1].contact);
  return limited(force, plan.limit_n);
}

/// Where the tool is and what it touches there: nothing where the pose is refused.
template <unsigned stages, class State>
std::span<Bite> meet(State& s, ToolState& tool, StepReport& report) noexcept {
  report.flags = (tool.valid ? 0u : kRefused) | (tool.dt_clamped ? kLongStep : 0u);
  if (!tool.valid) return {};
  if constexpr (stages & kPinch)
    if (tool.gap_mm == 0.0) tool.gap_mm = s.plan.gap_mm;

  const std::span<Bite> bites = touch<stages>(s, tool);
  for (const Bite& bite : bites)
    report.rings_touched += static_cast<std::uint32_t>(bite.contact.rings.size());
  if (report.rings_touched == 0) return {};
  report.flags |= kContact;
  return bites;
}

template <unsigned stages>
constexpr double kWidestGapMm = (stages & kPinch) ? kFarthestMm : 0.0;

/// The tick for a set of stages. A stage that the scene does not need is not in the code it runs.
template <unsigned stages, class State>
StepReport tick(State& s, const Pose& pose) noexcept {
  StepReport report;
  if (s.failure) {
    report.flags = kCollapsed;
    return report;
  }
  ToolState tool = s.tracker.advance(pose, kWidestGapMm<stages>);
  const std::span<Bite> bites = meet<stages>(s, tool, report);
  if (bites.empty()) return report;

  remove<stages>(s, tool, bites);
  report.flags |= deform<stages>(s, tool, bites);
  if constexpr (stages & kForce) {
    if (s.failure) return report;  // nothing is left to push against
    report.force_n = felt<stages>(s.plan.force, bites);
  }
  return report;
}

template <unsigned stages, class State>
StepReport feel(State& s, const Pose& pose) noexcept {
  StepReport report;
  if (s.failure) {
    report.flags = kCollapsed;
    return report;
  }
  ToolTracker tracker = s.tracker;
  ToolState tool = tracker.advance(pose, kWidestGapMm<stages>);
  const std::span<Bite> bites = meet<stages>(s, tool, report);
  if constexpr (stages & kForce)
    if (!bites.empty()) report.force_n = felt<stages>(s.plan.force, bites);
  return report;
}

template <class State, std::size_t... sets>
constexpr auto tick_table(std::index_sequence<sets...>) {
  return std::array{&tick<static_cast<unsigned>(sets), State>...};
}

template <class State, std::size_t... sets>
constexpr auto feel_table(std::index_sequence<sets...>) {
  return std::array{&feel<static_cast<unsigned>(sets), State>...};
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
  if (plan->stages & kStability) {
    if (const auto weak = StabilityWatch::check_all(plan->stability, *stack))
      return failure(ErrorKind::bad_input,
                     "stability.max_stress_kpa: expected more than the lump's own weight, found " +
                         number_text(plan->stability.max_stress_kpa) + " against " +
                         number_text(weak->stress_kpa) + " kPa at ring " +
                         std::to_string(weak->ring));
  }

  auto state = std::make_unique<State>();
  const std::size_t touches = most_contacts(plan->tool, lump.ring_height_mm, max_rings_of(lump));
  state->plan = std::move(*plan);
  state->stack = std::move(*stack);
  StackWriter(state->stack).reserve();
  state->ledger.initial = state->stack.volume();
  const std::size_t tools = (state->plan.stages & kPinch) ? 2 : 1;
  for (Bite& bite : std::span(state->bites).first(tools)) {
    bite.contact.rings.reserve(touches);
    bite.removed.reserve(touches);
  }
  static constexpr auto kTicks = tick_table<State>(std::make_index_sequence<kStageSets>{});
  static constexpr auto kFeels = feel_table<State>(std::make_index_sequence<kStageSets>{});
  state->tick = kTicks[state->plan.stages];
  state->feel = kFeels[state->plan.stages];
  return Wheel(std::move(state));
}

StepReport Wheel::step(const Pose& pose) noexcept { return state_->tick(*state_, pose); }
StepReport Wheel::feel(const Pose& pose) noexcept { return state_->feel(*state_, pose); }

const StepPlan& Wheel::plan() const noexcept { return state_->plan; }
const ClayStack& Wheel::stack() const noexcept { return state_->stack; }
const Ledger& Wheel::ledger() const noexcept { return state_->ledger; }
bool Wheel::collapsed() const noexcept { return state_->failure.has_value(); }

Pot Wheel::pot() const {
  const State& s = *state_;
  Pot pot{s.stack, s.ledger, s.plan.model, s.plan.density_g_cm3, {}, {}};
  if (s.failure)
    pot.collapse = settle(s.stack, s.plan.density_g_cm3, *s.failure, s.failure_hip,
                          s.plan.stability.max_stress_kpa);
  return pot;
}

}  // namespace clay
