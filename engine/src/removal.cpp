#include "removal.hpp"

#include "portable_math.hpp"
#include "yielding.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <span>

namespace clay {
namespace {

const Quanta kSmallestOuter2 = quanta_from_radius(kMinRadiusMm);

/// A ring keeps a quantum of clay and the smallest radius, whatever rounding does.
Quanta spare_outside(const Ring& ring) noexcept {
  return ring.outer2 - std::max(ring.inner2 + 1, kSmallestOuter2);
}
Quanta spare_inside(const Ring& ring) noexcept { return ring.volume() - 1; }

/// Delta v of a surface that moves by eps, as far as the ring has it to spare.
Quanta take_outside(const Ring& ring, double outer_mm, double eps) noexcept {
  const Quanta asked = quanta_from_mm2(eps * (2.0 * outer_mm - eps));
  return std::clamp<Quanta>(asked, 0, std::max<Quanta>(spare_outside(ring), 0));
}
Quanta take_inside(const Ring& ring, double inner_mm, double eps) noexcept {
  const Quanta asked = quanta_from_mm2(eps * (2.0 * inner_mm + eps));
  return std::clamp<Quanta>(asked, 0, std::max<Quanta>(spare_inside(ring), 0));
}

/// How far the surfaces of a pinched wall move in a tick: both for some of it, then one alone.
struct Pinched {
  double together_mm = 0.0;  ///< each
  double alone_mm = 0.0;     ///< the one whose tool is deeper in the clay
};

/// While both move the wall T shrinks at 2 kappa T, then at kappa T. When the shallower tool's
/// surface is reached T has fallen to T', which leaves e^-kappa(dt - t') = e^-(kappa dt)
/// sqrt(T / T') for the other: no logarithm is needed.
template <Model model>
Pinched pinched(double wall, double least_wall, double fraction, double shallow,
                double deep) noexcept {
  const double spare = wall - least_wall;
  if (!(spare > 0.0)) return {};
  if constexpr (model == Model::paper)
    return shallow > 0.0 ? Pinched{std::min(wall * fraction, 0.5 * spare), 0.0}
                         : Pinched{0.0, std::min(wall * fraction, spare)};
  Pinched moved;
  moved.together_mm = std::min({0.5 * wall * fraction * (2.0 - fraction), shallow, 0.5 * spare});
  if (moved.together_mm == shallow && deep > shallow) {
    const double left = wall - 2.0 * shallow;
    const double rest = 1.0 - (1.0 - fraction) * std::sqrt(wall / left);
    moved.alone_mm = std::max(0.0, std::min({left * rest, deep - shallow, spare - 2.0 * shallow}));
  }
  return moved;
}

/// use(ring, outer touch, inner touch) for every ring that a tool of a pinch touches; none where it
/// does not.
template <class Use>
void each_touched(Contact& outer, Contact& inner, Use use) noexcept {
  constexpr auto kNone = std::numeric_limits<std::uint32_t>::max();
  std::size_t o = 0, i = 0;
  while (o < outer.rings.size() || i < inner.rings.size()) {
    const auto next_o = o < outer.rings.size() ? outer.rings[o].ring : kNone;
    const auto next_i = i < inner.rings.size() ? inner.rings[i].ring : kNone;
    const auto ring = std::min(next_o, next_i);
    RingContact* outer_touch = next_o == ring ? &outer.rings[o++] : nullptr;
    RingContact* inner_touch = next_i == ring ? &inner.rings[i++] : nullptr;
    use(ring, outer_touch, inner_touch);
  }
}

double depth_in(const RingContact* touch) noexcept {
  return touch != nullptr ? touch->depth_mm : 0.0;
}

/// How far each surface of a pinched wall moves: outer, inner.
template <Model model>
std::array<double, 2> pinch_ring(const RemovalPlan& plan, double wall, double least_wall,
                                 double fraction, double dt_s,
                                 const std::array<const RingContact*, 2>& touches) noexcept {
  const double from_out = depth_in(touches[0]), from_in = depth_in(touches[1]);
  const Pinched moved = pinched<model>(wall, least_wall, fraction, std::min(from_out, from_in),
                                       std::max(from_out, from_in));
  std::array<double, 2> eps{moved.together_mm + (from_out > from_in ? moved.alone_mm : 0.0),
                            moved.together_mm + (from_in > from_out ? moved.alone_mm : 0.0)};
  if constexpr (model == Model::paper) return eps;
  Yielding both;
  std::size_t count = 0;
  for (const RingContact* touch : touches) {
    if (touch == nullptr) continue;
    both.wall[count] = wall;
    both.depth[count] = touch->depth_mm;
    both.advance[count] = touch->advance_mm;
    both.since[count] = touch->since;
    both.target[count++] = std::max(wall - from_out - from_in, least_wall);
  }
  yield(plan, dt_s, both, count);
  std::size_t k = 0;
  for (std::size_t side = 0; side < 2; ++side)
    if (touches[side] != nullptr) {
      eps[side] = std::min(eps[side], both.depth[k] - both.left[k]);
      ++k;
    }
  return eps;
}

void yield_to_tool(const RemovalPlan& plan, const ClayStack& stack, double dt_s, Contact& contact,
                   std::vector<Quanta>& removed) noexcept {
  const bool outside = contact.side == Side::compressive;
  const double min_wall = plan.min_wall_mm;
  Yielding block;
  std::array<double, Yielding::kMost> outer, inner, eps;
  for (std::size_t from = 0; from < contact.rings.size(); from += Yielding::kMost) {
    const std::size_t count = std::min(Yielding::kMost, contact.rings.size() - from);
    const std::span touched(contact.rings.data() + from, count);
    for (std::size_t k = 0; k < count; ++k) {
      const RingContact& touch = touched[k];
      const Ring& ring = stack.rings()[touch.ring];
      outer[k] = static_cast<double>(ring.outer2);
      inner[k] = static_cast<double>(ring.inner2);
      block.depth[k] = touch.depth_mm;
      block.advance[k] = touch.advance_mm;
      block.since[k] = touch.since;
    }
    for (std::size_t k = 0; k < count; ++k) {
      outer[k] = std::sqrt(outer[k] * kMm2PerQuantum);
      inner[k] = std::sqrt(inner[k] * kMm2PerQuantum);
      block.wall[k] = outer[k] - inner[k];
      block.target[k] = block.wall[k] - block.depth[k];
    }
    yield(plan, dt_s, block, count);
    for (std::size_t k = 0; k < count; ++k) {
      const double gone = block.depth[k] - block.left[k], spare = block.wall[k] - min_wall;
      const double most = spare > 0.0 ? spare : 0.0;
      eps[k] = gone < most ? gone : most;
      block.left[k] = block.depth[k] - eps[k];
    }
    for (std::size_t k = 0; k < count; ++k) {
      const Ring& ring = stack.rings()[touched[k].ring];
      removed.push_back(outside ? take_outside(ring, outer[k], eps[k])
                                : take_inside(ring, inner[k], eps[k]));
      touched[k].depth_mm = block.left[k];
    }
  }
}

}  // namespace

template <Model model>
void compute_removal(const RemovalPlan& plan, const ClayStack& stack, double dt_s, Contact& contact,
                     std::vector<Quanta>& removed) noexcept {
  removed.clear();
  if constexpr (model == Model::conserving)
    return yield_to_tool(plan, stack, dt_s, contact, removed);
  const bool outside = contact.side == Side::compressive;
  for (const RingContact& touch : contact.rings) {
    const Ring& ring = stack.rings()[touch.ring];
    const double outer = ring.outer_mm(), inner = ring.inner_mm();
    const double eps = (outer - inner) * plan.paper_fraction;
    removed.push_back(outside ? take_outside(ring, outer, eps) : take_inside(ring, inner, eps));
  }
}

template <Model model>
void compute_pinch_removal(const RemovalPlan& plan, const ClayStack& stack, double gap_mm,
                           double dt_s, Bite& outer, Bite& inner) noexcept {
  constexpr bool paper = model == Model::paper;
  const double least_wall = paper ? gap_mm : std::max(gap_mm, plan.min_wall_mm);
  const double fraction = paper ? plan.paper_fraction : one_minus_exp_neg(plan.rate_per_s * dt_s);
  outer.removed.clear();
  inner.removed.clear();
  each_touched(outer.contact, inner.contact, [&](auto index, auto* outer_touch, auto* inner_touch) {
    Ring ring = stack.rings()[index];
    const auto eps = pinch_ring<model>(plan, ring.outer_mm() - ring.inner_mm(), least_wall,
                                       fraction, dt_s, {outer_touch, inner_touch});
    if (outer_touch != nullptr) {
      outer.removed.push_back(take_outside(ring, ring.outer_mm(), eps[0]));
      ring.outer2 -= outer.removed.back();
      if constexpr (!paper) outer_touch->depth_mm -= eps[0];
    }
    if (inner_touch != nullptr) {
      inner.removed.push_back(take_inside(ring, ring.inner_mm(), eps[1]));
      if constexpr (!paper) inner_touch->depth_mm -= eps[1];
    }
  });
}

template void compute_removal<Model::paper>(const RemovalPlan&, const ClayStack&, double, Contact&,
                                            std::vector<Quanta>&) noexcept;
template void compute_removal<Model::conserving>(const RemovalPlan&, const ClayStack&, double,
                                                 Contact&, std::vector<Quanta>&) noexcept;
template void compute_pinch_removal<Model::paper>(const RemovalPlan&, const ClayStack&, double,
                                                  double, Bite&, Bite&) noexcept;
template void compute_pinch_removal<Model::conserving>(const RemovalPlan&, const ClayStack&, double,
                                                       double, Bite&, Bite&) noexcept;

}  // namespace clay
