#include "engine/clay/stack_writer.hpp"
#include "engine/tick/contact.hpp"
#include "engine/tick/force.hpp"
#include "engine/tick/front.hpp"
#include "engine/tick/joints.hpp"
#include "engine/tick/kernel_flow.hpp"
#include "engine/tick/rim_growth.hpp"
#include "engine/wheel/wheel_state.hpp"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <utility>

namespace clay {
namespace {

constexpr unsigned kStageSets = 64;

template <unsigned stages>
constexpr Model kModel = (stages & kPaperModel) ? Model::paper : Model::conserving;

/// The rings that the tool touches; of a pinch the outer tool first, then the inner one.
template <unsigned stages>
std::span<ToolRemoval> touch(WheelState& s, const ToolState& tool) noexcept {
  if constexpr (stages & kPinch) {
    if (tool.gap_mm > 0.0) {
      find_pinch<kModel<stages>>(s.plan.tool, s.stack, tool.hip_mm, tool.gap_mm,
                                 s.removals[0].contact, s.removals[1].contact, tool.moved_mm);
      return s.removals;
    }
  }
  const HandAt hand = !(stages & kRules)                   ? HandAt::unknown
                      : s.plan.mode == ToolMode::trim_foot ? HandAt::below
                                                           : HandAt::above;
  find_contact<kModel<stages>>(s.plan.tool, s.stack, tool.hip_mm, s.removals[0].contact,
                               tool.moved_mm, hand);
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

template <unsigned stages>
void remove(WheelState& s, const ToolState& tool, std::span<ToolRemoval> removals) noexcept {
  if constexpr (stages & kPinch) {
    if (removals.size() == 2)
      return compute_pinch_removal<kModel<stages>>(s.plan.removal, s.stack, tool.gap_mm, tool.dt_s,
                                                   removals[0], removals[1]);
  }
  compute_removal<kModel<stages>>(s.plan.removal, s.stack, tool.dt_s, removals[0].contact,
                                  removals[0].removed);
}

/// A sponge ignores the trim button.
bool trims(const WheelState& s, const ToolState& tool) noexcept {
  if (s.plan.mode == ToolMode::smooth) return false;
  return tool.trim || s.plan.mode == ToolMode::trim || s.plan.mode == ToolMode::trim_foot;
}

RulePress rule_press(const WheelState& s, const ToolState& tool) noexcept {
  return {s.plan, tool, s.motion, trims(s, tool)};
}

/// Computes the yielding of the clay, for the stack and for the force.
template <unsigned stages>
void yield(WheelState& s, const ToolState& tool, std::span<ToolRemoval> removals) noexcept {
  if constexpr (stages & kRules)
    s.rules.yield(rule_press(s, tool), s.stack, removals, s.work);
  else
    remove<stages>(s, tool, removals);
}

/// The ends of the tool, for the force. With clay rules also where no ring is touched, as between
/// two rings on the way down.
template <unsigned stages>
void measure_ends(WheelState& s, const ToolState& tool, std::span<ToolRemoval> removals) noexcept {
  if constexpr ((stages & kForce) && kModel<stages> == Model::conserving)
    for (std::size_t k = 0; k < removals.size(); ++k) {
      EndMotion motion{s.motion.upward_mm_s, s.ends[k]};
      measure_front(s.plan, s.stack, tool.hip_mm.y, tool.dt_s, removals[k].contact,
                    (stages & kRules) ? &motion : nullptr);
    }
}
template <unsigned stages>
constexpr bool kFeelsUntouched = (stages & kRules) != 0;

/// Checks whether the stack still stands after a flow. Returns the flags of the flow and of a
/// collapse.
template <unsigned stages>
std::uint32_t settle_flow(WheelState& s, const Flow& flow, const ToolState& tool) noexcept {
  if constexpr (stages & kStability) {
    s.failure = s.watch.check(s.plan.stability, s.stack, flow);
    if (s.failure) s.failure_hip_mm = tool.hip_mm;
  }
  return (flow.grown > 0 ? kGrew : 0u) | (flow.ring_limit ? kRingLimit : 0u) |
         (s.failure ? kCollapsed : 0u);
}

/// Of a pot that stands upside down: the rings of its foot that a flow has cut off the rest.
std::size_t loose_rings(const ClayStack& stack, const Flow& flow) noexcept {
  const auto rings = stack.rings();
  const std::size_t last = std::min(flow.highest + 1, rings.size() - 1);
  std::size_t loose = 0;
  for (std::size_t first = flow.lowest - std::min<std::size_t>(flow.lowest, 1); first < last;) {
    const auto gap = lowest_gap(rings, first, last);
    if (!gap) break;
    loose = first = *gap + 1;
  }
  return loose;
}

/// The cut-off part of the foot falls away. The pot, which is stored upright, is set down.
void drop_loose_rings(WheelState& s) noexcept {
  const double mm = static_cast<double>(s.loose_rings) * s.stack.ring_height_mm();
  s.ledger.trimmed += StackWriter(s.stack).cut_below(std::exchange(s.loose_rings, 0));
  *s.turned_mm -= mm;
  s.tracker.raise_origin(mm);
}

/// Moves the displaced clay, and checks whether the stack still stands.
template <unsigned stages>
std::uint32_t deform(WheelState& s, const ToolState& tool,
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

  if constexpr (stages & kRules)
    if (s.turned_mm) s.loose_rings = std::max(s.loose_rings, loose_rings(s.stack, flow));
  return settle_flow<stages>(s, flow, tool);
}

/// Clay that a tool prevented from rising becomes rings after the tool has left. A tool above the
/// rim keeps its room, although it touches no ring.
template <unsigned stages>
std::uint32_t raise_crown(WheelState& s, const ToolState& tool,
                          std::span<const ToolRemoval> removals) noexcept {
  if (s.stack.crown() < s.stack.rings().back().volume()) return 0;
  Flow flow;
  flow.lowest = flow.highest = s.stack.size() - 1;
  if constexpr (stages & kStability) s.watch.move_to(s.stack, flow.highest);
  Rim* const rim = (s.plan.clay.rules & kRim) ? nullptr : &s.rim;
  {
    StackWriter writer(s.stack);
    grow_rim(flow, s.plan, tool, removals, s.stack, rim, writer);
  }
  return settle_flow<stages>(s, flow, tool);
}

/// Clay leaves the touched rings on the tool's way, not at its end: the flow begins from the
/// middle.
template <unsigned stages>
void press(WheelState& s, const ToolState& tool, std::span<ToolRemoval> removals,
           StepReport& report) noexcept {
  const std::uint32_t touched = rings_of(removals);
  if (touched == 0) {
    if constexpr (kFeelsUntouched<stages>) measure_ends<stages>(s, tool, removals);
    return;
  }
  report.flags |= kContact;
  report.rings_touched = touched;
  if constexpr (kModel<stages> == Model::conserving) {
    const double half_way = 0.5 * tool.moved_mm.y / s.stack.ring_height_mm();
    removals[0].contact.up_offset += std::max(half_way, 0.0);
    removals[0].contact.down_offset += std::max(-half_way, 0.0);
  }
  yield<stages>(s, tool, removals);
  measure_ends<stages>(s, tool, removals);
  // The first pose takes no time. With clay rules a ring could still rise or be joined, and then a
  // session would not continue where it was cut.
  if ((stages & kRules) && !(tool.dt_s > 0.0)) return;
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

/// The tool at a pose, with its gap; not valid where the pose is refused or the pot has collapsed.
template <unsigned stages>
ToolState track_tool(const WheelState& s, ToolTracker& tracker, const Pose& pose,
                     StepReport& report) noexcept {
  if (s.failure) {
    report.flags = kCollapsed;
    return {};
  }
  ToolState tool = tracker.advance(pose, (stages & kPinch) ? kFarthestMm : 0.0);
  report.flags = (tool.valid ? 0u : kRefused) | (tool.dt_clamped ? kLongStep : 0u);
  if constexpr (stages & kPinch)
    if (tool.gap_mm == 0.0) tool.gap_mm = s.plan.gap_mm;
  return tool;
}

/// The tick for a set of stages. Its code omits the stages that the scene does not need.
template <unsigned stages>
StepReport tick(WheelState& s, const Pose& pose) noexcept {
  StepReport report;
  ToolState tool = track_tool<stages>(s, s.tracker, pose, report);
  if (!tool.valid) return report;
  std::span<ToolRemoval> removals = touch<stages>(s, tool);
  const bool touches = rings_of(removals) > 0;
  if constexpr (stages & kRules) follow(s.motion, tool);
  if constexpr (stages & kRules)
    if (!touches) report.flags |= raise_crown<stages>(s, tool, removals);
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
    if (!s.failure && (kFeelsUntouched<stages> || rings_of(removals) > 0))
      add_force<stages>(s.plan.force, removals, report);
  if constexpr (stages & kRules)
    if (s.loose_rings > 0) drop_loose_rings(s);
  return report;
}

/// Only the force of a tick: with the contact that the last part of the tick would find.
template <unsigned stages>
StepReport probe(WheelState& s, const Pose& pose) noexcept {
  StepReport report;
  ToolTracker tracker = s.tracker;
  ToolState tool = track_tool<stages>(s, tracker, pose, report);
  if (!tool.valid) return report;
  [[maybe_unused]] const ToolState whole = tool;
  const int parts = parts_of<kModel<stages>>(tool);
  tool.dt_s /= parts;
  tool.moved_mm /= parts;
  const std::span<ToolRemoval> removals = touch<stages>(s, tool);
  report.rings_touched = rings_of(removals);
  const bool touches = report.rings_touched > 0;
  if (touches) report.flags |= kContact;
  if (!touches && !kFeelsUntouched<stages>) return report;
  if constexpr (stages & kForce) {
    if constexpr (kModel<stages> == Model::conserving) {
      const Motion motion = s.motion;
      const auto ends = s.ends;
      if constexpr (stages & kRules) follow(s.motion, whole);
      if (touches) yield<stages>(s, tool, removals);
      measure_ends<stages>(s, tool, removals);
      s.motion = motion;
      s.ends = ends;
    }
    add_force<stages>(s.plan.force, removals, report);
  }
  return report;
}

template <std::size_t... sets>
constexpr auto tick_table(std::index_sequence<sets...>) {
  return std::array{&tick<static_cast<unsigned>(sets)>...};
}

template <std::size_t... sets>
constexpr auto probe_table(std::index_sequence<sets...>) {
  return std::array{&probe<static_cast<unsigned>(sets)>...};
}

}  // namespace

Tick press_tick(unsigned stages) noexcept {
  static constexpr auto kTicks = tick_table(std::make_index_sequence<kStageSets>{});
  static constexpr auto kProbes = probe_table(std::make_index_sequence<kStageSets>{});
  return {kTicks[stages], kProbes[stages]};
}

}  // namespace clay
