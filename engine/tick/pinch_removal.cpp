#include "engine/clay/portable_math.hpp"
#include "engine/tick/removal.hpp"
#include "engine/tick/yielding.hpp"

#include <algorithm>
#include <array>
#include <cmath>

namespace clay {
namespace {

/// Motion of the surfaces of a pinched wall in a tick: both for some time, then one alone.
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

/// A ring of a pinched wall, as a shift leaves it. Of its two surfaces, the outer one first.
struct PinchedRing {
  Ring ring;
  double wall_mm = 0.0;
  std::array<RingContact, 2> touches;
  std::array<double, 2> eps_mm;  ///< motion of each surface
};
/// Number of rings that yield in one call.
constexpr std::size_t kBatch = Yielding::kMost / 2;

template <Model model>
std::array<double, 2> motion_of(const PinchedRing& r, double least_wall, double fraction) noexcept {
  const double from_out = r.touches[0].depth_mm, from_in = r.touches[1].depth_mm;
  const Pinched moved = pinched<model>(r.wall_mm, least_wall, fraction, std::min(from_out, from_in),
                                       std::max(from_out, from_in));
  return {moved.together_mm + (from_out > from_in ? moved.alone_mm : 0.0),
          moved.together_mm + (from_in > from_out ? moved.alone_mm : 0.0)};
}

/// No surface moves faster than it yields to one tool near it.
void limit_to_yield(const RemovalPlan& plan, double dt_s, double least_wall,
                    std::span<PinchedRing> rings) noexcept {
  Yielding rows;
  std::array<double*, Yielding::kMost> eps_mm;
  std::size_t count = 0;
  for (PinchedRing& r : rings)
    for (std::size_t side = 0; side < 2; ++side) {
      const RingContact& touch = r.touches[side];
      if (!(touch.depth_mm > 0.0)) continue;
      rows.wall[count] = r.wall_mm;
      rows.depth[count] = touch.depth_mm;
      rows.advance[count] = touch.advance_mm;
      rows.since[count] = touch.since;
      rows.target[count] =
          std::max(r.wall_mm - r.touches[0].depth_mm - r.touches[1].depth_mm, least_wall);
      eps_mm[count++] = &r.eps_mm[side];
    }
  yield_each(plan, dt_s, rows, count);
  for (std::size_t k = 0; k < count; ++k)
    *eps_mm[k] = std::min(*eps_mm[k], rows.depth[k] - rows.left[k]);
}

/// Notes the clay that one tool removes from ring i.
template <Model model>
void note(ToolRemoval& removal, std::size_t i, Quanta removed, double eps_mm) noexcept {
  TouchedRings& rings = removal.contact.rings;
  removal.removed[i - rings.from()] = removed;
  if constexpr (model == Model::conserving) rings.depth(i) -= eps_mm;
}

/// The inner tool finds the clay that the outer one has left.
template <Model model>
void remove(PinchedRing& r, std::size_t i, ToolRemoval& outer, ToolRemoval& inner) noexcept {
  if (outer.contact.rings.has(i)) {
    const Quanta removed = take_outside(r.ring, r.ring.outer_mm(), r.eps_mm[0]);
    r.ring.outer2 -= removed;
    note<model>(outer, i, removed, r.eps_mm[0]);
  }
  if (inner.contact.rings.has(i))
    note<model>(inner, i, take_inside(r.ring, r.ring.inner_mm(), r.eps_mm[1]), r.eps_mm[1]);
}

}  // namespace

template <Model model>
void compute_pinch_removal(const RemovalPlan& plan, const ClayStack& stack, double gap_mm,
                           double dt_s, ToolRemoval& outer, ToolRemoval& inner,
                           const Squeeze* rules) noexcept {
  constexpr bool paper = model == Model::paper;
  const double least_wall = paper ? gap_mm : std::max(gap_mm, plan.min_wall_mm);
  const double fraction = paper ? plan.paper_fraction : one_minus_exp_neg(plan.rate_per_s * dt_s);
  const TouchedRings &out = outer.contact.rings, &in = inner.contact.rings;
  outer.removed.assign(out.size(), 0);
  inner.removed.assign(in.size(), 0);
  const std::size_t first = out.empty()  ? in.from()
                            : in.empty() ? out.from()
                                         : std::min(out.from(), in.from());
  const std::size_t end = std::max(out.to(), in.to());
  std::array<PinchedRing, kBatch> batch;
  for (std::size_t begin = first; begin < end; begin += kBatch) {
    const auto rings = std::span(batch).first(std::min(kBatch, end - begin));
    for (std::size_t k = 0; k < rings.size(); ++k) {
      const std::size_t i = begin + k;
      const Ring ring = rules != nullptr ? rules->ring(i, stack.rings()) : stack.rings()[i];
      rings[k] = {ring, wall_mm(ring), {out.get(i), in.get(i)}, {}};
      rings[k].eps_mm = motion_of<model>(rings[k], least_wall, fraction);
    }
    if constexpr (!paper) limit_to_yield(plan, dt_s, least_wall, rings);
    for (std::size_t k = 0; k < rings.size(); ++k) {
      const std::size_t i = begin + k;
      const bool closed = rules != nullptr && rings[k].ring.inner2 == 0;
      if (closed && rules->of_floor(i, stack.rings())) rings[k].eps_mm[1] = 0.0;
      remove<model>(rings[k], i, outer, inner);
    }
  }
}

template void compute_pinch_removal<Model::paper>(const RemovalPlan&, const ClayStack&, double,
                                                  double, ToolRemoval&, ToolRemoval&,
                                                  const Squeeze*) noexcept;
template void compute_pinch_removal<Model::conserving>(const RemovalPlan&, const ClayStack&, double,
                                                       double, ToolRemoval&, ToolRemoval&,
                                                       const Squeeze*) noexcept;

}  // namespace clay
