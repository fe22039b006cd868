#include "removal.hpp"

#include "portable_math.hpp"

#include <algorithm>

namespace clay {
namespace {

const Quanta kSmallestOuter2 = quanta_from_radius(kMinRadiusMm);

/// A ring keeps a quantum of clay and the smallest radius, whatever rounding does.
Quanta spare_outside(const Ring& ring) noexcept {
  return ring.outer2 - std::max(ring.inner2 + 1, kSmallestOuter2);
}
Quanta spare_inside(const Ring& ring) noexcept { return ring.volume() - 1; }

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

template void compute_removal<Model::paper>(const RemovalPlan&, const ClayStack&, const Contact&,
                                            double, std::vector<Quanta>&) noexcept;
template void compute_removal<Model::conserving>(const RemovalPlan&, const ClayStack&,
                                                 const Contact&, double,
                                                 std::vector<Quanta>&) noexcept;

}  // namespace clay
