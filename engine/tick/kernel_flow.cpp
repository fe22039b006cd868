#include "engine/tick/kernel_flow.hpp"

#include "engine/clay/stack_writer.hpp"

#include <algorithm>
#include <limits>

namespace clay {
namespace {

constexpr int kShareBits = 30;

/// Delta v_int = alpha Delta v, and Delta v_ext, the rest.
struct Split {
  WideQuanta inside, outside;
};

/// One ring's share, (5)-(8) in squared radii: R^2 gains, r^2 loses. Returns the clay that found
/// room.
template <class Amount>
Amount place(std::size_t ring, Amount inside, Amount outside, StackWriter& writer) noexcept {
  const Amount placed = inside > 0 ? writer.put_inside(ring, inside) : 0;
  return placed + writer.put_outside(ring, outside + inside - placed);
}

/// Gives `count` rings their shares, the j-th of them being ring_of(j). Returns the clay that is
/// left over. With a rim the last of them is the top ring: the rim records the additional clay that
/// the next ring would get.
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

/// As `distribute`; in 64 bits if the amounts fit, because that is faster.
template <class RingOf>
WideQuanta spread(const RayleighKernel& kernel, double offset, Split clay, std::size_t count,
                  RingOf ring_of, Rim* rim, ClayStack& stack) noexcept {
  if (clay.inside + clay.outside <= std::numeric_limits<Quanta>::max())
    return distribute(kernel, offset, static_cast<Quanta>(clay.inside),
                      static_cast<Quanta>(clay.outside), count, ring_of, rim, stack);
  return distribute(kernel, offset, clay.inside, clay.outside, count, ring_of, rim, stack);
}

/// Equations (5), (6): rings top+1 .. min(top+L1, N).
WideQuanta flow_up(const RayleighKernel& kernel, Split clay, const Contact& contact, Rim* rim,
                   ClayStack& stack) noexcept {
  const std::size_t top = contact.top, above = stack.size() - 1 - top;
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

}  // namespace

WideQuanta inside_part(WideQuanta amount, std::int64_t inside_share,
                       const ClayStack& stack) noexcept {
  return stack.hollow() ? (amount * inside_share) >> kShareBits : 0;
}

WideQuanta flow_by_kernel(const StepPlan& plan, WideQuanta amount, bool up, const Contact& contact,
                          Rim* rim, ClayStack& stack) noexcept {
  const WideQuanta inside = inside_part(amount, plan.inside_share, stack);
  const Split clay{inside, amount - inside};
  return up ? flow_up(*plan.kernel, clay, contact, rim, stack)
            : flow_down(*plan.kernel, clay, contact, stack);
}

}  // namespace clay
