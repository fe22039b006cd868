#include "engine/tick/redistribution.hpp"

#include "engine/clay/stack_writer.hpp"
#include "engine/tick/rim_growth.hpp"

#include <algorithm>
#include <cstdint>
#include <limits>

namespace clay {
namespace {

constexpr int kShareBits = 30;

WideQuanta take(std::span<const ToolRemoval> removals, ClayStack& stack) noexcept {
  StackWriter writer(stack);
  WideQuanta total = 0;
  for (const auto& [contact, removed] : removals)
    total += writer.take(contact.rings.from(), removed, contact.side == Side::compressive);
  return total;
}

struct Split {
  WideQuanta inside, outside;
};

/// Delta v_int = alpha Delta v, Delta v_ext = the rest. While no ring has a bore there is no
/// inner surface to add to.
Split split(WideQuanta amount, std::int64_t inside_share, const ClayStack& stack) noexcept {
  const WideQuanta inside = stack.hollow() ? (amount * inside_share) >> kShareBits : 0;
  return {inside, amount - inside};
}

/// One ring's share, (5)-(8) in squared radii: R^2 gains, r^2 loses. Returns what found room.
template <class Amount>
Amount place(std::size_t ring, Amount inside, Amount outside, StackWriter& writer) noexcept {
  const Amount placed = inside > 0 ? writer.put_inside(ring, inside) : 0;
  return placed + writer.put_outside(ring, outside + inside - placed);
}

/// Gives `count` rings their shares, the j-th of them being ring_of(j). Returns what is left over.
/// With a rim the last of them is the top ring: the rim records how much more the next would get.
template <class Amount, class RingOf>
Amount distribute(const RayleighKernel& kernel, double offset, Amount clay_inside,
                  Amount clay_outside, std::size_t count, RingOf ring_of, Rim* rim,
                  ClayStack& stack) noexcept {
  StackWriter writer(stack);
  Amount rest = clay_inside + clay_outside;
  RayleighKernel::ShareCursor cursor(kernel, offset);
  RayleighKernel::Shares<Amount> insides(clay_inside), outsides(clay_outside);
  Amount inside = 0, outside = 0;
  for (std::size_t j = 1; j <= count; ++j) {
    const std::int64_t part = cursor.next();
    inside = clay_inside > 0 ? insides.next(part) : 0;
    outside = outsides.next(part);
    rest -= place(ring_of(j), inside, outside, writer);
  }
  writer.gain(clay_inside + clay_outside - rest);
  if (rim != nullptr && count > 0) {
    const std::int64_t part = cursor.next();
    rim->inside += insides.next(part) - inside;
    rim->outside += outsides.next(part) - outside;
  }
  return rest;
}

/// In 64 bits where they do.
template <class RingOf>
WideQuanta spread(const RayleighKernel& kernel, double offset, Split clay, std::size_t count,
                  RingOf ring_of, Rim* rim, ClayStack& stack) noexcept {
  if (clay.inside + clay.outside <= std::numeric_limits<Quanta>::max())
    return distribute(kernel, offset, static_cast<Quanta>(clay.inside),
                      static_cast<Quanta>(clay.outside), count, ring_of, rim, stack);
  return distribute(kernel, offset, clay.inside, clay.outside, count, ring_of, rim, stack);
}

/// Equations (5), (6): rings top+1 .. min(top+L1, N).
WideQuanta flow_up(const RayleighKernel& kernel, Split clay, const Contact& contact,
                   std::size_t count, Rim* rim, ClayStack& stack) noexcept {
  const std::size_t top = contact.top, above = count - 1 - top;
  return spread(
      kernel, contact.up_offset, clay, std::min(flow_reach(kernel), above),
      [&](std::size_t j) { return top + j; }, above <= flow_reach(kernel) ? rim : nullptr, stack);
}

/// Equations (7), (8): rings max(1, bottom-L1) .. bottom-1.
WideQuanta flow_down(const RayleighKernel& kernel, Split clay, const Contact& contact,
                     ClayStack& stack) noexcept {
  return spread(
      kernel, contact.down_offset, clay, std::min(flow_reach(kernel), contact.bottom),
      [&](std::size_t j) { return contact.bottom - j; }, nullptr, stack);
}

/// A tool presses the crown with the top ring, and so makes both alike.
void level(Rim* rim, std::span<const ToolRemoval> removals, std::size_t count) noexcept {
  if (rim == nullptr) return;
  for (const auto& [contact, removed] : removals)
    if (!contact.rings.empty() && contact.rings.to() == count)
      (contact.side == Side::compressive ? rim->outside : rim->inside) = 0;
}

}  // namespace

template <Model model>
Flow press_clay(const StepPlan& plan, std::span<const ToolRemoval> removals, bool upward,
                ClayStack& stack, Ledger& ledger, Rim* rim) noexcept {
  StackWriter writer(stack);
  const Contact& contact = removals.front().contact;
  const std::size_t count = stack.size();
  const auto portions = [&](WideQuanta amount) { return split(amount, plan.inside_share, stack); };

  WideQuanta rest = take(removals, stack);
  level(rim, removals, count);
  if (!upward) rest = flow_down(*plan.kernel, portions(rest), contact, stack);
  if (rest > 0) rest = flow_up(*plan.kernel, portions(rest), contact, count, rim, stack);
  if constexpr (model == Model::paper)
    ledger.outside += rest;
  else
    writer.put_on_crown(rest);

  Flow flow;
  const std::size_t reach = flow_reach(*plan.kernel);
  flow.lowest = upward ? contact.bottom : contact.bottom - std::min(contact.bottom, reach);
  flow.highest = contact.top + std::min(reach, count - 1 - contact.top);
  grow_rings<model>(flow, stack, ledger, rim, writer);
  return flow;
}

template <Model model>
Flow trim_clay(std::span<const ToolRemoval> removals, ClayStack& stack, Ledger& ledger,
               Rim* rim) noexcept {
  StackWriter writer(stack);
  ledger.trimmed += take(removals, stack);
  level(rim, removals, stack.size());
  Flow flow;
  flow.lowest = removals.front().contact.bottom;
  flow.highest = removals.front().contact.top;
  // A thinner top ring may hold less than the excess.
  grow_rings<model>(flow, stack, ledger, rim, writer);
  return flow;
}

WideQuanta remove_clay(std::span<const ToolRemoval> removals, ClayStack& stack, Rim* rim) noexcept {
  level(rim, removals, stack.size());
  return take(removals, stack);
}

WideQuanta inside_part(WideQuanta amount, std::int64_t inside_share,
                       const ClayStack& stack) noexcept {
  return split(amount, inside_share, stack).inside;
}

WideQuanta flow_by_kernel(const StepPlan& plan, WideQuanta amount, bool up, const Contact& contact,
                          Rim* rim, ClayStack& stack) noexcept {
  const Split clay = split(amount, plan.inside_share, stack);
  return up ? flow_up(*plan.kernel, clay, contact, stack.size(), rim, stack)
            : flow_down(*plan.kernel, clay, contact, stack);
}

template Flow press_clay<Model::paper>(const StepPlan&, std::span<const ToolRemoval>, bool,
                                       ClayStack&, Ledger&, Rim*) noexcept;
template Flow press_clay<Model::conserving>(const StepPlan&, std::span<const ToolRemoval>, bool,
                                            ClayStack&, Ledger&, Rim*) noexcept;
template Flow trim_clay<Model::paper>(std::span<const ToolRemoval>, ClayStack&, Ledger&,
                                      Rim*) noexcept;
template Flow trim_clay<Model::conserving>(std::span<const ToolRemoval>, ClayStack&, Ledger&,
                                           Rim*) noexcept;

}  // namespace clay
