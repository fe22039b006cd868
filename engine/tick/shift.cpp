#include "engine/tick/shift.hpp"

#include "engine/clay/four.hpp"

#include <algorithm>
#include <cmath>

namespace clay {
namespace {

// Rings that one part of a tick may take out under the rim.
constexpr std::size_t kMostSunk = 64;
// A bore keeps half of its radius at least, however far a pose leaps.
constexpr double kMostOfBore = 0.75;

CLAYSTACK_INLINE inline Four smooth(Four t) noexcept { return t * t * (3.0 - 2.0 * t); }

/// Change of R^2 and the clay that a ring gives up [quanta].
struct Move {
  Four moved, raised;
};

/// In the plane of the ring: how far `by` moves it, less where its hoops are not thin, and
/// (R^2 - r^2) / (R^2 + r^2), the thickness over the middle radius.
struct Bent {
  Four by, thinness;
};
CLAYSTACK_INLINE inline Bent bend_rings(Four outer2, Four inner2, Four by) noexcept {
  const Four per_both = 1.0 / (outer2 + inner2);
  return {by * pliancy(outer2, inner2), (outer2 - inner2) * per_both};
}

CLAYSTACK_INLINE inline Move push_in(Four outer2, Four inner2, Four by, double hoop) noexcept {
  const Bent bent = bend_rings(outer2, inner2, by);
  const Four outer = rough_root(outer2 * kMm2PerQuantum), u = lesser(bent.by, outer);
  const Four q = lesser(u * (2.0 * outer - u) * kQuantaPerMm2, kMostOfBore * inner2);
  const Four most = lesser(q, kMostLaneQuanta);
  return {-most, hoop * most * bent.thinness};
}

CLAYSTACK_INLINE inline Move push_out(Four outer2, Four inner2, Four by, double hoop,
                                      double per_min_wall, double largest2) noexcept {
  const Bent bent = bend_rings(outer2, inner2, by);
  const Four outer = root(outer2 * kMm2PerQuantum);
  const Four inner = root(inner2 * kMm2PerQuantum);
  const Four room = 0.5 * ((outer2 - inner2) * kMm2PerQuantum * per_min_wall - outer - inner);
  const Four u = lesser(bent.by, greater(room, 0.0));
  const Four q = lesser(u * (2.0 * inner + u) * kQuantaPerMm2, greater(largest2 - outer2, 0.0));
  const Four most = lesser(q, kMostLaneQuanta);
  return {most, -hoop * most * bent.thinness};
}

}  // namespace

void Shift::reserve(std::size_t rings) { changes_.resize(in_fours(rings)); }

void Shift::clear() noexcept {
  count_ = 0;
  raised_total_ = 0;
}

void Shift::begin(const ClayStack& stack, const Band& band, const Shell& shell) noexcept {
  clear();
  const double h = stack.ring_height_mm(), count = static_cast<double>(stack.size());
  const double above = shell.above_mm / std::max(shell.turn, 1e-3);
  const double low = std::clamp(std::floor((band.peak_mm - shell.below_mm) / h), 0.0, count - 1.0);
  const double high = std::clamp(std::ceil((band.peak_mm + above) / h), low + 1.0, count);
  from_ = static_cast<std::size_t>(low);
  // Within what was reserved: a band and a shell on either side of it.
  count_ = std::min(static_cast<std::size_t>(high) - from_, changes_.size());
}

void Shift::bend(double h, const Band& band, const Shell& shell, std::size_t first,
                 std::size_t count, double* by) noexcept {
  const double amplitude = shell.share * band.give_mm;
  const double per_below = 1.0 / shell.below_mm;
  const double per_above = greater(shell.turn, 0.0) / shell.above_mm;
  const double flare = greater(-shell.turn, 0.0) / shell.above_mm;
  const double low = amplitude * shell.trail_below, high = amplitude * shell.trail_above;
  const double start = (static_cast<double>(first) + 0.5) * h - band.peak_mm;
  in_lanes([=]() CLAYSTACK_INLINE {
    for (std::size_t k = 0; k < count; k += kFour) {
      const Four x = start + load_four(&kLevels[k]) * h;
      const Four t = greater(1.0 + lesser(x * per_below, -x * per_above), 0.0);
      const Four side = x < 0.0 ? all_of(low) : all_of(high);
      store(by + k, side * (smooth(t) + greater(x, 0.0) * flare));
    }
  });
}

void Shift::move(const ClayStack& stack, const Push& push, std::size_t first, std::size_t count,
                 const double* by) noexcept {
  static const double largest2 = static_cast<double>(quanta_from_radius(kMaxRadiusMm));
  Quanta sum = 0;  // of 32 rings: fits
  in_lanes([=, rings = stack.rings().data() + first, changes = &changes_[first - from_],
            hoop = push.hoop ? 0.5 : 0.0, per_min_wall = 1.0 / push.min_wall_mm,
            outward = push.outward, most = largest2, total = &sum]() CLAYSTACK_INLINE {
    FourQuanta raised_sum{};
    for (std::size_t k = 0; k < count; k += kFour) {
      const FourRings four = load_four(rings + k, count - k);
      const Four outer2 = four_doubles(four.outer2), inner2 = four_doubles(four.inner2);
      const Four u = load_four(by + k);
      const Move m = outward ? push_out(outer2, inner2, u, hoop, per_min_wall, most)
                             : push_in(outer2, inner2, u, hoop);
      const FourQuanta moved = four_quanta(m.moved), raised = four_quanta(m.raised);
      store(changes + k, FourRings{moved, moved + raised});
      raised_sum += row_numbers(k) < static_cast<Quanta>(count) ? raised : FourQuanta{};
    }
    *total = raised_sum[0] + raised_sum[1] + raised_sum[2] + raised_sum[3];
  });
  raised_total_ += sum;
}

/// A wall that sinks must find its clay above it.
void Shift::settle(const ClayStack& stack) noexcept {
  if (raised_total_ >= 0) return;
  WideQuanta found = stack.crown();
  const auto rings = stack.rings();
  for (std::size_t k = 1; k <= kMostSunk && found + raised_total_ < 0 && k < rings.size(); ++k)
    found += after(rings.size() - k, rings[rings.size() - k]).volume();
  if (found + raised_total_ >= 0) return;
  for (Ring& change : std::span(changes_).first(count_)) change.inner2 = change.outer2;
  raised_total_ = 0;
}

}  // namespace clay
