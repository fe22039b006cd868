#include "claystack/engine/wheel.hpp"

#include "collapse.hpp"
#include "contact.hpp"
#include "force.hpp"
#include "redistribution.hpp"
#include "removal.hpp"
#include "stability.hpp"
#include "stack_writer.hpp"
#include "tool_state.hpp"

#include <algorithm>
#include <array>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace clay {

struct Wheel::State {
  StepPlan plan;
  ClayStack stack;
  Ledger ledger;
  ToolTracker tracker;
  StabilityWatch watch;
  Contact contact;              // scratch, reserved once
  std::vector<Quanta> removed;  // scratch, reserved once
  std::optional<Failure> failure;
  glm::dvec3 failure_hip{0.0};
  StepReport (*tick)(State&, const Pose&) noexcept = nullptr;
};

namespace {

/// Moves the clay that the tool displaces, and sees whether the stack still stands.
template <unsigned stages, Model model, class State>
std::uint32_t deform(State& s, const ToolState& tool) noexcept {
  if constexpr (stages & kStability)
    s.watch.move_to(s.stack, std::min(s.contact.top + s.plan.kernel.length(), s.stack.size() - 1));

  const bool trim = tool.trim || s.plan.mode == ToolMode::trim;
  const Flow flow =
      trim ? trim_clay<model>(s.contact, s.removed, s.stack, s.ledger)
           : press_clay<model>(s.plan, s.contact, s.removed, tool.upward, s.stack, s.ledger);

  if constexpr (stages & kStability) {
    s.failure = s.watch.check(s.plan.stability, s.stack, flow.lowest, flow.grown);
    if (s.failure) s.failure_hip = tool.hip_mm;
  }
  return (flow.grown > 0 ? kGrew : 0u) | (flow.ring_limit ? kRingLimit : 0u) |
         (s.failure ? kCollapsed : 0u);
}

/// The tick for a set of stages. A stage that the scene does not need is not in the code it runs.
template <unsigned stages, class State>
StepReport tick(State& s, const Pose& pose) noexcept {
  constexpr Model model = (stages & kPaperModel) ? Model::paper : Model::conserving;
  StepReport report;
  if (s.failure) {
    report.flags = kCollapsed;
    return report;
  }
  const ToolState tool = s.tracker.advance(pose);
  report.flags = (tool.valid ? 0u : kRefused) | (tool.dt_clamped ? kLongStep : 0u);
  if (!tool.valid) return report;

  find_contact(s.plan.tool, s.stack, tool.hip_mm, s.contact);
  if (s.contact.rings.empty()) return report;
  report.flags |= kContact;
  report.rings_touched = static_cast<std::uint32_t>(s.contact.rings.size());

  compute_removal<model>(s.plan.removal, s.stack, s.contact, tool.dt_s, s.removed);
  report.flags |= deform<stages, model>(s, tool);

  if constexpr (stages & kForce) {
    if (s.failure) return report;  // nothing is left to push against
    report.force_n = spring_force<model>(s.plan.force, s.contact);
    if constexpr (stages & kFriction)
      report.force_n += friction_force(s.plan.force, s.contact, report.force_n);
    report.force_n = limited(report.force_n, s.plan.force.limit_n);
  }
  return report;
}

template <class State, std::size_t... sets>
constexpr auto tick_table(std::index_sequence<sets...>) {
  return std::array{&tick<static_cast<unsigned>(sets), State>...};
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
                         std::to_string(plan->stability.max_stress_kpa) + " against " +
                         std::to_string(weak->stress_kpa) + " kPa at ring " +
                         std::to_string(weak->ring));
  }

  auto state = std::make_unique<State>();
  const std::size_t touches = most_contacts(plan->tool, lump.ring_height_mm, max_rings_of(lump));
  state->plan = std::move(*plan);
  state->stack = std::move(*stack);
  StackWriter(state->stack).reserve();
  state->ledger.initial = state->stack.volume();
  state->contact.rings.reserve(touches);
  state->removed.reserve(touches);
  static constexpr auto kTicks = tick_table<State>(std::make_index_sequence<kStageSets>{});
  state->tick = kTicks[state->plan.stages];
  return Wheel(std::move(state));
}

StepReport Wheel::step(const Pose& pose) noexcept { return state_->tick(*state_, pose); }

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
