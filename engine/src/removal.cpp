#include "removal.hpp"

#include "portable_math.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace clay {
namespace {

const Quanta kSmallestOuter2 = quanta_from_radius(kMinRadiusMm);

/// A ring keeps a quantum of clay and the smallest radius, whatever rounding does.
Quanta spare_outside(const Ring& ring) noexcept {
  return ring.outer2 - std::max(ring.inner2 + 1, kSmallestOuter2);
}
Quanta spare_inside(const Ring& ring) noexcept { return ring.volume() - 1; }

/// Delta v of a surface that moves by eps, as far as the ring has it to spare.
Quanta take_outside(const Ring& ring, double eps) noexcept {
  const Quanta asked = quanta_from_mm2(eps * (2.0 * ring.outer_mm() - eps));
  return std::clamp<Quanta>(asked, 0, std::max<Quanta>(spare_outside(ring), 0));
}
Quanta take_inside(const Ring& ring, double eps) noexcept {
  const Quanta asked = quanta_from_mm2(eps * (2.0 * ring.inner_mm() + eps));
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

/// use(ring, outer depth, inner depth) for every ring that a tool of a pinch touches; the depth is
/// 0 where it does not.
template <class Use>
void each_touched(const Contact& outer, const Contact& inner, Use use) noexcept {
  constexpr auto kNone = std::numeric_limits<std::uint32_t>::max();
  std::size_t o = 0, i = 0;
  while (o < outer.rings.size() || i < inner.rings.size()) {
    const auto next_o = o < outer.rings.size() ? outer.rings[o].ring : kNone;
    const auto next_i = i < inner.rings.size() ? inner.rings[i].ring : kNone;
    const auto ring = std::min(next_o, next_i);
    const double outer_depth = next_o == ring ? outer.rings[o++].depth_mm : 0.0;
    const double inner_depth = next_i == ring ? inner.rings[i++].depth_mm : 0.0;
    use(ring, outer_depth, inner_depth);
  }
}

}  // namespace

template <Model model>
void compute_removal(const RemovalPlan& plan, const ClayStack& stack, const Contact& contact,
                     double dt_s, std::vector<Quanta>& removed) noexcept {
  const bool outside = contact.side == Side::compressive;
  const double fraction =
      model == Model::paper ? plan.paper_fraction : one_minus_exp_neg(plan.rate_per_s * dt_s);
  removed.clear();
  for (const RingContact& touch : contact.rings) {
    const Ring& ring = stack.rings()[touch.ring];
    const double outer = ring.outer_mm(), inner = ring.inner_mm();
    double eps = (outer - inner) * fraction;
    if constexpr (model == Model::conserving)
      eps = std::max(0.0, std::min({eps, touch.depth_mm, outer - inner - plan.min_wall_mm}));
    const double mm2 = outside ? eps * (2.0 * outer - eps) : eps * (2.0 * inner + eps);
    const Quanta spare = outside ? spare_outside(ring) : spare_inside(ring);
    removed.push_back(std::clamp<Quanta>(quanta_from_mm2(mm2), 0, std::max<Quanta>(spare, 0)));
  }
}

void yield_edges(const RemovalPlan& plan, const ClayStack& stack, double rise_mm, double dt_s,
                 Contact& contact) noexcept {
  if (!(dt_s > 0.0)) return;
  for (std::size_t k = 0; k < contact.edge_count; ++k) {
    RingContact& edge = contact.edges[k];
    const Ring& ring = stack.rings()[edge.ring];
    const double wall = ring.outer_mm() - ring.inner_mm();
    if (contact.edge_end[k] == 0 || !(wall > plan.min_wall_mm)) continue;
    const double ahead = std::max(rise_mm * contact.edge_end[k], 0.0);
    const double covered = edge.coverage * stack.ring_height_mm();
    // All is pressed away at depth / (kappa (R - r)) times the speed behind the end.
    const double yielded = plan.rate_per_s * wall * dt_s * covered;
    const double whole = edge.depth_mm * ahead;
    edge.depth_mm *= yielded <= whole ? (whole > 0.0 ? 1.0 - 0.5 * yielded / whole : 1.0)
                                      : 0.5 * whole / yielded;
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
  each_touched(outer.contact, inner.contact, [&](auto index, double from_out, double from_in) {
    Ring ring = stack.rings()[index];
    const Pinched moved = pinched<model>(ring.outer_mm() - ring.inner_mm(), least_wall, fraction,
                                         std::min(from_out, from_in), std::max(from_out, from_in));
    if (from_out > 0.0) {
      const double alone = from_out > from_in ? moved.alone_mm : 0.0;
      outer.removed.push_back(take_outside(ring, moved.together_mm + alone));
      ring.outer2 -= outer.removed.back();
    }
    if (from_in > 0.0) {
      const double alone = from_in > from_out ? moved.alone_mm : 0.0;
      inner.removed.push_back(take_inside(ring, moved.together_mm + alone));
    }
  });
}

template void compute_removal<Model::paper>(const RemovalPlan&, const ClayStack&, const Contact&,
                                            double, std::vector<Quanta>&) noexcept;
template void compute_removal<Model::conserving>(const RemovalPlan&, const ClayStack&,
                                                 const Contact&, double,
                                                 std::vector<Quanta>&) noexcept;
template void compute_pinch_removal<Model::paper>(const RemovalPlan&, const ClayStack&, double,
                                                  double, Bite&, Bite&) noexcept;
template void compute_pinch_removal<Model::conserving>(const RemovalPlan&, const ClayStack&, double,
                                                       double, Bite&, Bite&) noexcept;

}  // namespace clay
