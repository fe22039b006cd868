#include "engine/tick/clay_rules.hpp"

#include "engine/clay/in_place.hpp"
#include "engine/clay/stack_writer.hpp"
#include "engine/tick/bending.hpp"
#include "engine/tick/heave.hpp"
#include "engine/tick/joints.hpp"
#include "engine/tick/kernel_flow.hpp"
#include "engine/tick/lump.hpp"
#include "engine/tick/relief.hpp"
#include "engine/tick/rim_growth.hpp"
#include "engine/tick/shell.hpp"
#include "engine/tick/smear.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace clay {
namespace {

// Time constant of the mean motion: longer than the steps of an encoder at 1 kHz, shorter than the
// changes of direction of a hand.
constexpr double kMemoryS = 0.05;

template <unsigned rules>
constexpr bool kOneToolBand = (rules & (kShift | kHeave | kSmear)) != 0;
template <unsigned rules>
constexpr bool kTwoToolBand = (rules & (kShift | kHeave | kSmear)) != 0 || !(rules & kLift);

/// Sets the rings that the flow may change.
template <unsigned rules>
void set_flow_range(const RulePress& press, const ClayStack& stack,
                    std::span<const ToolRemoval> removals, RuleWork& work) noexcept {
  const Contact& contact = removals.front().contact;
  const bool lifts = (rules & kLift) && removals.size() == 2;
  double low_mm = 1e300, high_mm = -1e300;
  for (std::size_t k = 0; k < removals.size(); ++k) {
    const Band& band = work.bands[k];
    if (removals[k].contact.rings.empty()) continue;
    const auto widen = [&](double below_mm, double above_mm) {
      low_mm = std::min(low_mm, band.low_mm - below_mm);
      high_mm = std::max(high_mm, band.high_mm + above_mm);
    };
    if constexpr (rules & kHeave) {
      if (work.cones[k][0].meets) widen(kReliefMm, 0.0);
      if (work.cones[k][1].meets) widen(0.0, kReliefMm);
    }
    if (press.trim) continue;
    if constexpr (rules & kSmear) widen(band.height_mm(), band.height_mm());
    if constexpr (rules & kHeave) {
      if (!lifts) {
        const double reach = work.reach_mm[k] = heave_reach(press.plan.tool, stack, band);
        widen(2.0 * reach, 2.0 * reach);
      }
    }
  }
  if constexpr (rules & kHeave)
    if (work.finger.stands()) high_mm = std::max(high_mm, work.finger.to_mm);
  const double h = stack.ring_height_mm(), top = static_cast<double>(stack.size() - 1);
  const auto ring_at = [=](double level) {
    return static_cast<std::size_t>(std::clamp(level, 0.0, top));
  };
  work.lowest = std::min(contact.bottom, ring_at(low_mm / h - 1.0));
  work.highest = std::max(contact.top, ring_at(high_mm / h + 1.0));
  if (!work.shift.empty()) {
    work.lowest = std::min(work.lowest, work.shift.from());
    work.highest = std::max(work.highest, work.shift.to() - 1);
  }
  if (!press.trim && !lifts && !(rules & kHeave)) {
    const std::size_t reach = flow_reach(*press.plan.kernel);
    work.lowest = std::min(work.lowest, contact.bottom - std::min(contact.bottom, reach));
    work.highest = std::max(work.highest, std::min(stack.size() - 1, contact.top + reach));
  }
}

/// Computes the distances by which the clay gives way in each contact, and the bands that the rules
/// need.
template <unsigned rules>
void give_way_to(const RulePress& press, const ClayStack& stack, std::span<ToolRemoval> removals,
                 RuleWork& work) noexcept {
  const StepPlan& plan = press.plan;
  const double hip_y = press.tool.hip_mm.y;
  const bool two = removals.size() == 2;
  if (two && !kTwoToolBand<rules>) return;
  const bool sinks = (rules & kHeave) && plan.clay.rim_sinks && !two;
  for (std::size_t k = 0; k < removals.size(); ++k) {
    Contact& contact = removals[k].contact;
    if (contact.rings.empty()) continue;
    give_way(plan.removal, stack, press.tool.dt_s, contact);
    if (sinks) work.pressed = press_rim(plan.tool, press.motion, stack, hip_y, contact);
    if (two || kOneToolBand<rules>)
      make_in_place(work.bands[k], [&] { return band_of(plan.tool, stack, hip_y, contact); });
  }
}

/// The cones beyond the contacts, with the clay in them that the tools touch, and the finger.
void find_undercuts(const RulePress& press, const ClayStack& stack, const Squeeze& squeeze,
                    std::span<ToolRemoval> removals, RuleWork& work) noexcept {
  ToolState aside = press.tool;
  aside.dt_s *= work.pressed.aside;
  for (std::size_t k = 0; k < removals.size(); ++k)
    if (!removals[k].contact.rings.empty())
      make_in_place(work.cones[k], [&] {
        return relieve_touched(press.plan, work.shoulders, stack, aside, work.bands[k], squeeze,
                               removals, k, press.trim);
      });
  work.finger = {};
  if (removals.size() == 1 && !press.trim)
    work.finger = finger_of(press.plan, press.tool, stack, removals[0].contact);
}

template <unsigned rules>
void yield_clay(const RulePress& press, const ClayStack& stack, std::span<ToolRemoval> removals,
                RuleWork& work) noexcept {
  const StepPlan& plan = press.plan;
  work.shift.clear();
  work.walls.begin(removals.front().contact.bottom);
  work.pressed = {};
  give_way_to<rules>(press, stack, removals, work);
  const bool may_close = plan.clay.narrow_rim_closes && !press.trim;
  const bool lifts = (may_close || plan.clay.pressed_lump_stretches) &&
                     place_of_stretch(plan, stack, press.tool, removals);
  work.stretches = lifts && removals.size() == 1 && work.pressed.aside == 1.0;
  const bool closes = may_close && !lifts;
  work.rim = closes ? rim_limit(stack, plan.tool, press.tool.hip_mm.y, removals) : RimLimit{};
  const Squeeze squeeze{plan.removal.min_wall_mm, plan.clay.floor_rings,
                        plan.mode == ToolMode::trim_foot, (rules & kShift) ? &work.shift : nullptr};
  const bool shifts = (rules & kShift) && !press.trim;
  if (removals.size() == 2) {
    if (shifts)
      centre(plan, stack, press.tool, work.bands, removals, work.walls, work.rim, work.over,
             work.shift);
    compute_pinch_removal<Model::conserving>(plan.removal, stack, press.tool.gap_mm,
                                             press.tool.dt_s, removals[0], removals[1], &squeeze);
  } else {
    Contact& contact = removals[0].contact;
    if (shifts)
      bend_wall(plan, press.motion, stack, contact, work.bands[0], work.walls, work.give_sums,
                work.rim, work.shift);
    squeeze_out(squeeze, stack, contact, removals[0].removed);
  }
  if constexpr (rules & kHeave) find_undercuts(press, stack, squeeze, removals, work);
  set_flow_range<rules>(press, stack, removals, work);
}

/// The part of an amount that flows up, continuous in the speed. In turns: in each period the clay
/// first flows up for that part of the time, then down, so that a tick seldom lays it to both
/// sides.
WideQuanta upward_part(WideQuanta amount, const Motion& motion, const ToolState& tool) noexcept {
  const double v = motion.upward_mm_s;
  const double up = 0.5 * (1.0 + v / std::sqrt(v * v + kSlowMmS * kSlowMmS));
  if (!(tool.dt_s > 0.0)) return (amount * static_cast<std::int64_t>(up * 0x1p30)) >> 30;
  // Time of upward flow up to a moment, in periods.
  const auto upward_by = [up](double periods) {
    const double whole = std::floor(periods);
    return whole * up + std::min(periods - whole, up);
  };
  constexpr double kPerPeriod = 1e6 / static_cast<double>(kClockPeriodUs);
  const double now = tool.phase_s * kPerPeriod, took = tool.dt_s * kPerPeriod;
  const double part = std::clamp((upward_by(now) - upward_by(now - took)) / took, 0.0, 1.0);
  return (amount * static_cast<std::int64_t>(part * 0x1p30)) >> 30;
}

/// The part of the clay that one tool squeezes out that goes inside: the scene's share. It is less
/// if a tool squeezes a wall from outside that is thicker than the contact is high: the flow of a
/// punch does not reach through it. Clay of a rim that is pressed down goes to both sides.
std::int64_t inside_share(const StepPlan& plan, const ClayStack& stack, const Contact& contact,
                          const Band& band, double aside) noexcept {
  if (contact.side == Side::expansive) return plan.inside_share;
  const double w = wall_mm(stack.rings()[std::min(band.ring, stack.size() - 1)]);
  const double c = std::max(band.height_mm(), stack.ring_height_mm());
  const double reach = c * c / (c * c + w * w), more = (1.0 - aside) * (1.0 - reach);
  const auto through = static_cast<std::int64_t>((reach + more) * 0x1p20);
  return (plan.inside_share * through) >> 20;
}

/// Lays the clay that one tool squeezed out beside it; that of a pressed rim goes down. Returns the
/// part that becomes height. Clay that would make a narrow rim too high goes down.
template <unsigned rules>
WideQuanta displace(const RulePress& press, std::span<const ToolRemoval> removals, RuleWork& work,
                    const LooseClay& loose, double yields_mm, ClayStack& stack, Rim* rim) noexcept {
  const StepPlan& plan = press.plan;
  const std::size_t at = removals[0].contact.rings.empty() ? removals.size() - 1 : 0;
  const Contact& contact = removals[at].contact;
  [[maybe_unused]] const std::int64_t share =
      inside_share(plan, stack, contact, work.bands[at], work.pressed.aside);
  const auto flow = [&](WideQuanta part, bool up) {
    if (part == 0) return part;
    if constexpr (rules & kHeave) {
      StackWriter writer(stack);
      WideQuanta rest = 0;
      for (WideQuanta left = part; left > 0;) {
        const auto piece = static_cast<Quanta>(std::min(left, WideQuanta{kLargestHeap}));
        const auto inside = static_cast<Quanta>(inside_part(piece, share, stack));
        const Quanta over =
            heave(plan.tool, stack, work.walls, press.tool.hip_mm.y, contact, work.bands[at],
                  {inside, piece - inside, up, work.reach_mm[at], plan.clay.heave_slope,
                   work.finger.stands() ? &work.finger : nullptr},
                  writer);
        writer.gain(piece - over);
        rest += over;
        left -= piece;
        if (left > 0) work.walls.begin(contact.bottom);
      }
      return rest;
    } else {
      return flow_by_kernel(plan, part, up, removals.front().contact, rim, stack);
    }
  };
  const WideQuanta stretched = work.stretches ? stretched_clay(loose.total, stack, work.bands[at],
                                                               yields_mm, press.motion.upward_mm_s)
                                              : 0;
  const WideQuanta heaps = loose.total - stretched;
  const WideQuanta up = upward_part(heaps, press.motion, press.tool);
  const WideQuanta rest = stretched + flow(up + flow(heaps - up + work.pressed.down, false), true);
  if (!(rest > 0 && loose.rim.limits())) return rest;
  const WideQuanta rises = std::min(rest, static_cast<WideQuanta>(loose.raising));
  work.walls.begin(contact.bottom);
  return rises + flow(rest - rises, false);
}

/// Removes the clay that the tools squeeze out.
void take_squeezed(std::span<const ToolRemoval> removals, ClayStack& stack, Rim* rim,
                   LooseClay& loose) noexcept {
  loose.total += remove_clay(removals, stack, rim);
  if (!loose.rim.limits()) return;
  for (const auto& [contact, removed] : removals)
    for (std::size_t k = 0; k < removed.size(); ++k)
      loose.raise(removed[k], stack.rings()[contact.rings.from() + k]);
}

/// Removes the clay in the cones beyond the contacts, and in the way of the finger. Returns the
/// height of the clay that yields in the cones [mm].
double relieve(const RulePress& press, std::span<const ToolRemoval> removals, const RuleWork& work,
               const ClayStack& stack, StackWriter& writer, LooseClay& loose) noexcept {
  const double dt_s = press.tool.dt_s * work.pressed.aside;
  const bool bends = press.plan.clay.pushed_wall_bends && removals.size() == 1;
  std::size_t yielding = 0;
  for (std::size_t k = 0; k < removals.size(); ++k)
    if (!removals[k].contact.rings.empty())
      for (const Cone& cone : work.cones[k])
        if (cone.meets)
          yielding += relieve_beyond(press.plan, cone, stack, dt_s, removals[k].contact,
                                     bends && cone.outside, writer, loose);
  if (work.finger.stands())
    relieve_finger(press.plan, work.finger, stack, dt_s, removals[0].contact, writer, loose);
  return static_cast<double>(yielding) * stack.ring_height_mm();
}

/// Smears the surface that each tool presses, once in a third of a period.
void smear_surfaces(const RulePress& press, std::span<const ToolRemoval> removals,
                    const RuleWork& work, const ClayStack& stack, StackWriter& writer) noexcept {
  const StepPlan& plan = press.plan;
  for (std::size_t k = 0; k < removals.size(); ++k)
    if (!removals[k].contact.rings.empty())
      smear(plan.tool, stack, press.tool.hip_mm.y, press.tool.slow_s, removals[k].contact,
            work.bands[k],
            {plan.clay.surface_per_s, plan.removal.yield_depth_mm, plan.removal.min_wall_mm},
            writer);
}

/// A cutter cannot thin a rim at its minimum, but the clay below it. Cuts off a tip no higher than
/// thick, if the cutter's depth in it and its projection over the ring below exceed the ring
/// height. Returns its clay.
WideQuanta cut_ledge(const StepPlan& plan, const Contact& contact, const ClayStack& stack,
                     StackWriter& writer, Flow& flow) noexcept {
  constexpr double kNearMm = 1e-3;
  const double h = stack.ring_height_mm(), min_wall = plan.removal.min_wall_mm;
  const auto rings = stack.rings();
  const std::size_t top = rings.size() - 1;
  std::size_t tip = rings.size();
  for (std::size_t i = top; i > 0 && contact.rings.has(i); --i) {
    const Ring &ring = rings[i], &below = rings[i - 1];
    if (!(contact.rings.get(i).depth_mm > h && wall_mm(ring) < min_wall + kNearMm)) break;
    const double high = static_cast<double>(rings.size() - i) * h;
    if (high > min_wall && i != top) break;
    const double out = contact.side == Side::expansive ? below.inner_mm() - ring.inner_mm()
                                                       : ring.outer_mm() - below.outer_mm();
    if (out > h) tip = i;
  }
  if (tip > top) return 0;
  flow.lip = tip;
  flow.sunk += rings.size() - tip;
  for (const Ring& ring : rings.subspan(tip)) flow.sunk_volume += ring.volume();
  return writer.cut_above(tip);
}

/// A cutter cuts the crown with the top ring, which held `before`: otherwise the same clay would be
/// higher on a thinner ring. Returns the clay.
WideQuanta cut_crown(const ClayStack& stack, Quanta before, StackWriter& writer) noexcept {
  const WideQuanta crown = stack.crown(), left = crown * stack.rings().back().volume() / before;
  const WideQuanta cut = std::max<WideQuanta>(crown - left, 0);
  writer.put_on_crown(-cut);
  return cut;
}

/// Keeps the rings that may have changed on their neighbours. Returns whether some of them hardly
/// overlapped.
bool keep_joined(const RulePress& press, std::span<const ToolRemoval> removals,
                 const RuleWork& work, const ClayStack& stack, StackWriter& writer) noexcept {
  const std::size_t top = stack.size() - 1, last = std::min(work.highest, top);
  const std::size_t from = work.lowest - std::min<std::size_t>(work.lowest, 1);
  const double min_wall = press.plan.removal.min_wall_mm, least = kJointPart * min_wall;
  if (!has_weak_joint(stack.rings().subspan(from, std::min(last + 1, top) + 1 - from), least))
    return false;
  if (removals.size() == 1)
    join_rings(stack, work.lowest, last,
               {removals[0].contact.side == Side::expansive, least, min_wall}, writer);
  else
    thicken_joints(stack, work.lowest, last, least,
                   {press.plan.tool, press.tool.hip_mm.y, removals}, writer);
  return true;
}

template <unsigned rules>
Flow move_clay(const RulePress& press, std::span<const ToolRemoval> removals, RuleWork& work,
               ClayStack& stack, Ledger& ledger, Rim& all_rim) noexcept {
  const StepPlan& plan = press.plan;
  Rim* const rim = (rules & kRim) ? nullptr : &all_rim;
  const Quanta top_before = stack.rings().back().volume();
  StackWriter writer(stack);
  if constexpr (rules & kShift) {
    writer.change(work.shift.from(), work.shift.changes());
    writer.gain(-work.shift.raised());
    writer.put_on_crown(work.shift.raised());
  }
  LooseClay loose{work.rim};
  take_squeezed(removals, stack, rim, loose);
  double yields_mm = work.bands[0].height_mm();
  if constexpr (rules & kHeave) yields_mm += relieve(press, removals, work, stack, writer, loose);
  Flow flow;
  if (press.trim && plan.clay.thin_wall_yields && plan.mode != ToolMode::trim_foot)
    for (const ToolRemoval& removal : removals)
      loose.total += cut_ledge(plan, removal.contact, stack, writer, flow);
  if (press.trim && plan.clay.rim_sinks) loose.total += cut_crown(stack, top_before, writer);
  limit_to_rim(stack, work.pressed);
  writer.put_on_crown(-work.pressed.down);
  if (press.trim)
    ledger.trimmed += loose.total + work.pressed.down;
  else if ((rules & kLift) && removals.size() == 2)
    writer.put_on_crown(loose.total);
  else
    writer.put_on_crown(displace<rules>(press, removals, work, loose, yields_mm, stack, rim));
  if constexpr (rules & kSmear)
    if (!press.trim && press.tool.slow_s > 0.0)
      smear_surfaces(press, removals, work, stack, writer);
  if constexpr (rules & kShift)
    if (!press.trim) flow.weak = keep_joined(press, removals, work, stack, writer);
  const std::size_t top = stack.size() - 1;
  flow.lowest = std::min(work.lowest, top);
  flow.highest = std::min(work.highest, top);
  if (stack.crown() < 0)
    sink_rim(flow, plan.tool, press.tool.hip_mm.y, removals, stack, writer);
  else if (work.pressed.aside == 1.0)
    grow_rim(flow, plan, press.tool, removals, stack, rim, writer);
  return flow;
}

void yield_to_sponge(const RulePress& press, const ClayStack& stack,
                     std::span<ToolRemoval> removals, RuleWork& work) noexcept {
  work.shift.clear();
  Contact& contact = removals[0].contact;
  removals[0].removed.assign(contact.rings.size(), 0);
  contact.rings.each_slice([](const TouchedRings::Slice& slice) {
    for (std::size_t k = slice.begin; k < slice.end; ++k) slice.rows.give[k] = 0.0;
  });
  work.bands[0] = band_of(press.plan.tool, stack, press.tool.hip_mm.y, contact);
  set_flow_range<kSmear | kLift>(press, stack, removals, work);
}

Flow smooth_clay(const RulePress& press, std::span<const ToolRemoval> removals, RuleWork& work,
                 ClayStack& stack, Ledger&, Rim&) noexcept {
  const StepPlan& plan = press.plan;
  StackWriter writer(stack);
  smear(plan.tool, stack, press.tool.hip_mm.y, press.tool.dt_s, removals[0].contact, work.bands[0],
        {plan.clay.surface_per_s, plan.removal.yield_depth_mm, plan.removal.min_wall_mm, true,
         plan.clay.sponge_follows},
        writer);
  Flow flow;
  flow.lowest = work.lowest;
  flow.highest = work.highest;
  return flow;
}

template <std::size_t... sets>
constexpr auto steps_table(std::index_sequence<sets...>) {
  return std::array{RuleSteps{&yield_clay<static_cast<unsigned>(sets)>,
                              &move_clay<static_cast<unsigned>(sets)>}...};
}

}  // namespace

void follow(Motion& motion, const ToolState& tool) noexcept {
  if (!(tool.dt_s > 0.0)) return;
  const auto distance = [](const glm::dvec3& p) { return std::sqrt(p.x * p.x + p.z * p.z); };
  const double out = distance(tool.hip_mm) - distance(tool.hip_mm - tool.moved_mm);
  const double part = 1.0 / (kMemoryS + tool.dt_s);
  motion.upward_mm_s += part * (tool.moved_mm.y - tool.dt_s * motion.upward_mm_s);
  motion.outward_mm_s += part * (out - tool.dt_s * motion.outward_mm_s);
}

void RuleWork::reserve(const Tool& tool, const ClayStack& stack) {
  const double reach = tool.high() - tool.low() + 3.0 * kLongestShellMm;
  const double rings = reach / stack.ring_height_mm() + 8.0;
  walls.reserve(tool, stack);
  shoulders = shoulders_of(tool);
  const std::size_t contacts = most_contacts(tool, stack.ring_height_mm(), stack.max_rings());
  over.reserve(contacts);
  give_sums.resize(sums_for(contacts));
  shift.reserve(static_cast<std::size_t>(std::min(rings, static_cast<double>(stack.max_rings()))));
}

RuleSteps sponge_steps() noexcept { return {&yield_to_sponge, &smooth_clay}; }

RuleSteps rule_steps(unsigned rules) noexcept {
  static constexpr auto kSteps = steps_table(std::make_index_sequence<kRuleSets>{});
  return kSteps[rules];
}

}  // namespace clay
