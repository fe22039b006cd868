#include "redistribution.hpp"

#include "stack_writer.hpp"

#include <algorithm>

namespace clay {
namespace {

constexpr int kShareBits = 30;

// A tick has a bounded length; the crown holds what is left for the next one.
constexpr std::size_t kMostGrowthPerTick = 64;

WideQuanta take(std::span<const Bite> bites, StackWriter& writer) noexcept {
  WideQuanta total = 0;
  for (const auto& [contact, removed] : bites) {
    for (std::size_t k = 0; k < removed.size(); ++k) {
      if (contact.side == Side::compressive)
        writer.take_outside(contact.rings[k].ring, removed[k]);
      else
        writer.take_inside(contact.rings[k].ring, removed[k]);
      total += removed[k];
    }
  }
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
WideQuanta place(std::size_t ring, WideQuanta inside, WideQuanta outside,
                 StackWriter& writer) noexcept {
  const WideQuanta placed = inside > 0 ? writer.put_inside(ring, inside) : 0;
  return placed + writer.put_outside(ring, outside + inside - placed);
}

/// Gives `count` rings their shares, the j-th of them being ring_of(j). Returns what is left over.
template <class RingOf>
WideQuanta spread(const RayleighKernel& kernel, Split clay, std::size_t count, RingOf ring_of,
                  StackWriter& writer) noexcept {
  WideQuanta rest = clay.inside + clay.outside;
  RayleighKernel::Dealer inside(kernel, clay.inside), outside(kernel, clay.outside);
  for (std::size_t j = 1; j <= count; ++j)
    rest -= place(ring_of(j), clay.inside > 0 ? inside.next() : 0, outside.next(), writer);
  return rest;
}

/// Equations (5), (6): rings top+1 .. min(top+L1, N).
WideQuanta flow_up(const RayleighKernel& kernel, Split clay, std::size_t top, std::size_t count,
                   StackWriter& writer) noexcept {
  const std::size_t reach = std::min(kernel.length(), count - 1 - top);
  return spread(
      kernel, clay, reach, [&](std::size_t j) { return top + j; }, writer);
}

/// Equations (7), (8): rings max(1, bottom-L1) .. bottom-1.
WideQuanta flow_down(const RayleighKernel& kernel, Split clay, std::size_t bottom,
                     StackWriter& writer) noexcept {
  const std::size_t reach = std::min(kernel.length(), bottom);
  return spread(
      kernel, clay, reach, [&](std::size_t j) { return bottom - j; }, writer);
}

/// Steps (a), (b): whole rings from the excess. `paper` keeps the remainder outside the body,
/// below one top ring after every tick; `conserving` shows it as the crown.
template <Model model>
void grow(Flow& flow, ClayStack& stack, Ledger& ledger, StackWriter& writer) noexcept {
  while (true) {
    const Quanta top = stack.rings().back().volume();
    if ((model == Model::paper ? ledger.outside : stack.crown()) < top) return;
    flow.ring_limit = stack.size() >= stack.max_rings();
    if (flow.ring_limit) return;
    if (model == Model::conserving && flow.grown >= kMostGrowthPerTick) return;
    if constexpr (model == Model::paper)
      ledger.outside -= top;
    else
      writer.put_on_crown(-top);
    writer.grow();
    ++flow.grown;
  }
}

}  // namespace

template <Model model>
Flow press_clay(const StepPlan& plan, std::span<const Bite> bites, bool upward, ClayStack& stack,
                Ledger& ledger) noexcept {
  StackWriter writer(stack);
  const Contact& contact = bites.front().contact;
  const std::size_t count = stack.size();
  const auto portions = [&](WideQuanta amount) { return split(amount, plan.inside_share, stack); };

  WideQuanta rest = take(bites, writer);
  if (!upward) rest = flow_down(plan.kernel, portions(rest), contact.bottom, writer);
  if (rest > 0) rest = flow_up(plan.kernel, portions(rest), contact.top, count, writer);
  if constexpr (model == Model::paper)
    ledger.outside += rest;
  else
    writer.put_on_crown(rest);

  Flow flow;
  flow.lowest =
      upward ? contact.bottom : contact.bottom - std::min(contact.bottom, plan.kernel.length());
  flow.highest = contact.top + std::min(plan.kernel.length(), count - 1 - contact.top);
  grow<model>(flow, stack, ledger, writer);
  return flow;
}

template <Model model>
Flow trim_clay(std::span<const Bite> bites, ClayStack& stack, Ledger& ledger) noexcept {
  StackWriter writer(stack);
  ledger.trimmed += take(bites, writer);
  Flow flow;
  flow.lowest = bites.front().contact.bottom;
  flow.highest = bites.front().contact.top;
  grow<model>(flow, stack, ledger, writer);  // a thinner top ring may be worth less than the excess
  return flow;
}

template Flow press_clay<Model::paper>(const StepPlan&, std::span<const Bite>, bool, ClayStack&,
                                       Ledger&) noexcept;
template Flow press_clay<Model::conserving>(const StepPlan&, std::span<const Bite>, bool,
                                            ClayStack&, Ledger&) noexcept;
template Flow trim_clay<Model::paper>(std::span<const Bite>, ClayStack&, Ledger&) noexcept;
template Flow trim_clay<Model::conserving>(std::span<const Bite>, ClayStack&, Ledger&) noexcept;

}  // namespace clay
