#include "engine/tick/redistribution.hpp"

#include "engine/clay/stack_writer.hpp"
#include "engine/tick/kernel_flow.hpp"
#include "engine/tick/rim_growth.hpp"

#include <algorithm>

namespace clay {
namespace {

/// The crown has the radii of the top ring. So a tool that presses the top ring removes the excess
/// of clay that the rim holds on that side.
void level_rim(Rim* rim, std::span<const ToolRemoval> removals, std::size_t count) noexcept {
  if (rim == nullptr) return;
  for (const auto& [contact, removed] : removals)
    if (!contact.rings.empty() && contact.rings.to() == count)
      (contact.side == Side::compressive ? rim->outside : rim->inside) = 0;
}

}  // namespace

WideQuanta remove_clay(std::span<const ToolRemoval> removals, ClayStack& stack, Rim* rim) noexcept {
  level_rim(rim, removals, stack.size());
  StackWriter writer(stack);
  WideQuanta total = 0;
  for (const auto& [contact, removed] : removals)
    total += writer.take(contact.rings.from(), removed, contact.side == Side::compressive);
  return total;
}

template <Model model>
Flow press_clay(const StepPlan& plan, std::span<const ToolRemoval> removals, bool upward,
                ClayStack& stack, Ledger& ledger, Rim* rim) noexcept {
  StackWriter writer(stack);
  const Contact& contact = removals.front().contact;
  const std::size_t top = stack.size() - 1;
  WideQuanta rest = remove_clay(removals, stack, rim);
  if (!upward) rest = flow_by_kernel(plan, rest, false, contact, rim, stack);
  if (rest > 0) rest = flow_by_kernel(plan, rest, true, contact, rim, stack);
  if constexpr (model == Model::paper)
    ledger.outside += rest;
  else
    writer.put_on_crown(rest);

  Flow flow;
  const std::size_t reach = flow_reach(*plan.kernel);
  flow.lowest = upward ? contact.bottom : contact.bottom - std::min(contact.bottom, reach);
  flow.highest = contact.top + std::min(reach, top - contact.top);
  grow_rings<model>(flow, stack, ledger, rim, writer);
  return flow;
}

template <Model model>
Flow trim_clay(std::span<const ToolRemoval> removals, ClayStack& stack, Ledger& ledger,
               Rim* rim) noexcept {
  StackWriter writer(stack);
  ledger.trimmed += remove_clay(removals, stack, rim);
  Flow flow;
  flow.lowest = removals.front().contact.bottom;
  flow.highest = removals.front().contact.top;
  // A thinner top ring may hold less than the excess.
  grow_rings<model>(flow, stack, ledger, rim, writer);
  return flow;
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
